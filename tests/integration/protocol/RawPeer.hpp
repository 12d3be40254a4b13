#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Testing
{

enum class EFrame : std::uint8_t
{
    Continuation = 0,
    Text = 1,
    Binary = 2,
    Close = 8,
    Ping = 9,
    Pong = 10,
};

/// One WebSocket frame of RFC 6455, unmasked.
struct RawFrame
{
    EFrame kind = EFrame::Text;
    std::string payload;
    bool bFinal = true;
};

/// The bytes of a frame; with the mask (of zeros) that a client must put on it.
[[nodiscard]] std::string MakeFrame(const RawFrame& frame, bool bMasked);

/// Only the head of a frame that announces `size` bytes.
[[nodiscard]] std::string MakeFrameHead(const RawFrame& frame, std::uint64_t size, bool bMasked);

/// One end of a TCP connection that writes WebSocket frames itself, so that tests can send wrong ones.
class RawPeer : public std::enable_shared_from_this<RawPeer>
{
    using Tcp = boost::asio::ip::tcp;

    Tcp::socket _socket;
    std::array<char, 65'536> _chunk{};
    std::string _received;
    std::string _request;
    bool _bEnded = false;
    bool _bReading = false;

public:
    /// After every arrival and at the end.
    std::function<void()> onChange;

    explicit RawPeer(Tcp::socket socket);

    /// To a port of 127.0.0.1.
    [[nodiscard]] static std::shared_ptr<RawPeer> Connect(boost::asio::io_context& io, std::uint16_t port);

    /// Starts reading.
    void ReadAsync();
    void StopReading();
    void Write(std::string_view bytes);

    /// As a client: asks for the WebSocket.
    void WriteUpgrade();

    /// As a server: accepts the upgrade request; false while it is incomplete.
    [[nodiscard]] bool TryUpgrade();

    /// RST instead of FIN.
    void Reset();
    void Close();

    /// The next whole frame of what came.
    [[nodiscard]] std::optional<RawFrame> TakeFrameOrNull();

    /// As a client: the server's answer, removed from what came; empty where it is not whole yet.
    [[nodiscard]] std::string TakeHead();

    /// What came and was not taken.
    [[nodiscard]] const std::string& GetReceived() const noexcept
    {
        return _received;
    }

    /// What the client asked for.
    [[nodiscard]] const std::string& GetRequest() const noexcept
    {
        return _request;
    }

    [[nodiscard]] bool HasEnded() const noexcept
    {
        return _bEnded;
    }
};

} // namespace ACS::Testing
