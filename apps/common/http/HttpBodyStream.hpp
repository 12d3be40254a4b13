#pragma once

#include <functional>
#include <string>

namespace ACS::Apps
{

/// The body of a response that continues after its header, such as server-sent events. The server takes a piece when the
/// peer has read the one before: a peer that reads slowly occupies the memory of one piece. The peer sees the end of the
/// connection as the end of the body. Shared by the owner of the contents and the server; used on the server's thread.
class HttpBodyStream final
{
public:
    /// Returns the next piece, of at most some 64 KiB; empty: there is none at present.
    using Source = std::function<std::string()>;
    using Handler = std::function<void()>;

private:
    Source _takeNext;
    Handler _onChange;
    bool _bOpen = true;

public:
    /// The source is not called after the end of the stream.
    explicit HttpBodyStream(Source takeNext);
    HttpBodyStream(const HttpBodyStream&) = delete;
    HttpBodyStream& operator=(const HttpBodyStream&) = delete;
    ~HttpBodyStream() = default;

    /// By the owner: the source has a piece. May call the source at once.
    void Notify();

    /// By the owner or the server: no further piece is taken, and the connection is closed.
    void End();

    /// False after the end; the owner forgets the stream then.
    [[nodiscard]] bool IsOpen() const noexcept;

    /// By the server: onChange is called after Notify and once at the end.
    void Attach(Handler onChange);

    /// By the server. Empty: none at present, or the stream has ended.
    [[nodiscard]] std::string TakeNext() const;
};

} // namespace ACS::Apps
