#include "RawPeer.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/write.hpp>
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace ACS::Testing
{

namespace
{

using ErrorCode = boost::system::error_code;

constexpr std::string_view HEAD_END = "\r\n\r\n";
constexpr std::string_view LOOPBACK = "127.0.0.1";
constexpr unsigned FINAL_BIT = 0x80U;
constexpr unsigned MASK_BIT = 0x80U;
constexpr unsigned SHORT_LENGTH = 0x7FU;
constexpr unsigned TWO_BYTES = 126;
constexpr unsigned EIGHT_BYTES = 127;
constexpr std::size_t MASK_SIZE = 4;
constexpr unsigned BITS_PER_BYTE = 8;

unsigned GetByte(std::string_view bytes, std::size_t index)
{
    return static_cast<unsigned char>(bytes[index]);
}

/// Of RFC 6455, section 4.2.2.
std::string MakeAccept(const std::string& key)
{
    const std::string text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
    std::array<unsigned char, SHA_DIGEST_LENGTH> digest{};
    SHA1(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data()); // required by OpenSSL
    std::array<unsigned char, 64> encoded{};
    const int size = EVP_EncodeBlock(encoded.data(), digest.data(), static_cast<int>(digest.size()));
    return {encoded.begin(), encoded.begin() + size};
}

std::string FindHeader(const std::string& request, std::string name)
{
    std::string lowered = request;
    const auto lower = [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    };
    std::ranges::transform(lowered, lowered.begin(), lower);
    std::ranges::transform(name, name.begin(), lower);
    const std::size_t found = lowered.find("\r\n" + name + ": ");
    if (found == std::string::npos)
    {
        return {};
    }
    const std::size_t begin = found + name.size() + 4;
    return request.substr(begin, request.find("\r\n", begin) - begin);
}

} // namespace

std::string MakeFrameHead(const RawFrame& frame, std::uint64_t size, bool bMasked)
{
    const unsigned mask = bMasked ? MASK_BIT : 0U;
    std::string bytes;
    const auto add = [&bytes](std::uint64_t value) {
        bytes.push_back(static_cast<char>(value & 0xFFU));
    };
    add((frame.bFinal ? FINAL_BIT : 0U) | static_cast<unsigned>(frame.kind));
    std::size_t lengthBytes = 0;
    if (size < TWO_BYTES)
    {
        add(mask | size);
    }
    else
    {
        lengthBytes = size <= 0xFFFFU ? 2 : 8;
        add(mask | (lengthBytes == 2 ? TWO_BYTES : EIGHT_BYTES));
    }
    for (std::size_t left = lengthBytes; left > 0; --left)
    {
        add(size >> (BITS_PER_BYTE * (left - 1)));
    }
    bytes.append(bMasked ? MASK_SIZE : 0, '\0');
    return bytes;
}

std::string MakeFrame(const RawFrame& frame, bool bMasked)
{
    return MakeFrameHead(frame, frame.payload.size(), bMasked) + frame.payload;
}

RawPeer::RawPeer(Tcp::socket socket)
    : _socket(std::move(socket))
{
}

std::shared_ptr<RawPeer> RawPeer::Connect(boost::asio::io_context& io, std::uint16_t port)
{
    Tcp::socket socket(io);
    socket.connect({boost::asio::ip::make_address(LOOPBACK), port});
    return std::make_shared<RawPeer>(std::move(socket));
}

void RawPeer::ReadAsync()
{
    _bReading = true;
    _socket.async_read_some(
        boost::asio::buffer(_chunk),
        [self = shared_from_this()](const ErrorCode& error, std::size_t count) {
            if (error == boost::asio::error::operation_aborted)
            {
                return;
            }
            self->_received.append(self->_chunk.data(), count);
            self->_bEnded = static_cast<bool>(error);
            if (self->onChange)
            {
                self->onChange();
            }
            if (!error && self->_bReading)
            {
                self->ReadAsync();
            }
        });
}

void RawPeer::StopReading()
{
    _bReading = false;
    ErrorCode ignored;
    static_cast<void>(_socket.cancel(ignored));
}

void RawPeer::Write(std::string_view bytes)
{
    ErrorCode ignored; // the other side may have gone
    static_cast<void>(boost::asio::write(_socket, boost::asio::buffer(bytes.data(), bytes.size()), ignored));
}

void RawPeer::WriteUpgrade()
{
    Write("GET /acs/ HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
}

std::string RawPeer::TakeHead()
{
    const std::size_t end = _received.find(HEAD_END);
    if (end == std::string::npos)
    {
        return {};
    }
    std::string head = _received.substr(0, end + HEAD_END.size());
    _received.erase(0, head.size());
    return head;
}

bool RawPeer::TryUpgrade()
{
    if (_request.empty())
    {
        _request = TakeHead();
        if (_request.empty())
        {
            return false;
        }
        Write(
            "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: "
            + MakeAccept(FindHeader(_request, "Sec-WebSocket-Key")) + std::string(HEAD_END));
    }
    return true;
}

void RawPeer::Reset()
{
    ErrorCode ignored;
    static_cast<void>(_socket.set_option(boost::asio::socket_base::linger(true, 0), ignored));
    Close();
}

void RawPeer::Close()
{
    _bReading = false;
    ErrorCode ignored;
    static_cast<void>(_socket.close(ignored));
}

std::optional<RawFrame> RawPeer::TakeFrameOrNull()
{
    const std::string_view bytes = _received;
    if (bytes.size() < 2)
    {
        return std::nullopt;
    }
    RawFrame frame;
    frame.bFinal = (GetByte(bytes, 0) & FINAL_BIT) != 0;
    frame.kind = static_cast<EFrame>(GetByte(bytes, 0) & 0x0FU);
    const bool bMasked = (GetByte(bytes, 1) & MASK_BIT) != 0;
    std::uint64_t size = GetByte(bytes, 1) & SHORT_LENGTH;
    std::size_t lengthBytes = 0;
    if (size >= TWO_BYTES)
    {
        lengthBytes = size == TWO_BYTES ? 2 : 8;
    }
    const std::size_t head = 2 + lengthBytes + (bMasked ? MASK_SIZE : 0);
    if (bytes.size() < head)
    {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < lengthBytes; ++i)
    {
        size = (i == 0 ? 0 : size << BITS_PER_BYTE) | GetByte(bytes, 2 + i);
    }
    if (bytes.size() - head < size)
    {
        return std::nullopt;
    }
    frame.payload = bytes.substr(head, size);
    for (std::size_t i = 0; bMasked && i < frame.payload.size(); ++i)
    {
        const unsigned mask = GetByte(bytes, head - MASK_SIZE + i % MASK_SIZE);
        frame.payload[i] = static_cast<char>(GetByte(frame.payload, i) ^ mask);
    }
    _received.erase(0, head + size);
    return frame;
}

} // namespace ACS::Testing
