#include "CodecParts.hpp"

#include <algorithm>

namespace ACS::OpenStream
{

namespace
{

constexpr unsigned char FIRST_PRINTABLE = 0x21;
constexpr unsigned char RUBOUT = 0x7F;

} // namespace

OpenStreamCodec::OpenStreamCodec()
    : _scratch(std::make_unique<Scratch>())
{
}

OpenStreamCodec::OpenStreamCodec(OpenStreamCodec&&) noexcept = default;
OpenStreamCodec& OpenStreamCodec::operator=(OpenStreamCodec&&) noexcept = default;
OpenStreamCodec::~OpenStreamCodec() = default;

bool IsURL(std::string_view url) noexcept
{
    const auto isRefused = [](char letter) {
        const auto byte = static_cast<unsigned char>(letter);
        return byte < FIRST_PRINTABLE || byte == RUBOUT;
    };
    return url.starts_with('/') && std::ranges::none_of(url, isRefused);
}

std::string_view GetMethodText(EApiMethod method) noexcept
{
    return Json::GetWord(method);
}

} // namespace ACS::OpenStream
