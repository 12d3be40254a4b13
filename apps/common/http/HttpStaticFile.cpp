#include "common/http/HttpStaticFile.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <array>
#include <optional>
#include <span>

namespace ACS::Apps
{

namespace
{

constexpr unsigned HTTP_OK = 200;
constexpr unsigned HTTP_NOT_MODIFIED = 304;
constexpr std::size_t TAG_BYTES = 16;
constexpr const char* POLICY =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; font-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

std::string MakeTag(std::string_view contents)
{
    std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
    static_cast<void>(EVP_Digest(contents.data(), contents.size(), hash.data(), nullptr, EVP_sha256(), nullptr));
    return fmt::format("\"{:02x}\"", fmt::join(std::span(hash).first<TAG_BYTES>(), ""));
}

} // namespace

HttpStaticFile::HttpStaticFile(std::string_view contentType, std::string_view contents)
    : _contentType(contentType),
      _contents(contents),
      _tag(MakeTag(contents))
{
}

HttpResponse HttpStaticFile::Respond(const HttpRequest& request) const
{
    HttpResponse response{HTTP_OK, std::string(_contentType)};
    response.headers = {
        {"ETag", _tag},
        {"Cache-Control", "no-cache"},
        {"Content-Security-Policy", POLICY},
        {"X-Content-Type-Options", "nosniff"},
        {"Referrer-Policy", "no-referrer"}};
    // A list of tags, each perhaps with W/ in front. No tag is part of another one, because of its quotes.
    const std::string known = request.GetHeaderOrNull("If-None-Match").value_or("");
    if (known == "*" || known.find(_tag) != std::string::npos)
    {
        response.status = HTTP_NOT_MODIFIED;
        return response;
    }
    response.body = _contents;
    return response;
}

} // namespace ACS::Apps
