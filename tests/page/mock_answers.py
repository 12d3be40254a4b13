"""Answers to a POST that are not those of acsd: for MockAcsd.answer_post, called with the handler of the request."""


def send_cut(handler):
    """The answer of acsd breaks off after 10 of its 100 bytes."""
    handler.send_response(202)
    handler.send_header("Content-Type", "application/json")
    handler.send_header("Content-Length", "100")
    handler.end_headers()
    handler.wfile.write(b'{"message"')
    handler.close_connection = True


def send_bad_gateway(handler):
    """A proxy has lost acsd."""
    handler.send_bytes(502, "text/html", b"<html><h1>502 Bad Gateway</h1></html>")


def send_page(handler):
    """A proxy answers with a page of its own."""
    handler.send_bytes(200, "text/html", b"<html><h1>Sign in</h1></html>")


def send_refusal_of_proxy(handler):
    """JSON, but not that of acsd."""
    handler.send_bytes(504, "application/json", b'{"reason": "upstream timed out"}')
