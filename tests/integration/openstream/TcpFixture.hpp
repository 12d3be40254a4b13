#pragma once

#include "Catch.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include "SteadySystemClock.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace ACS::Testing
{

inline constexpr std::chrono::seconds LIMIT{10};

class CountingService final : public OpenStream::IOpenApiService
{
public:
    int gets = 0;
    int controls = 0;
    int stops = 0;
    std::chrono::milliseconds duration{0}; ///< Of a call: how slow the service is.

    void Call(const OpenStream::ApiRequest& request, Core::Now /*now*/, OpenStream::ApiResponse& response) override
    {
        if (request.method == OpenStream::EApiMethod::Get)
        {
            ++gets;
            std::this_thread::sleep_for(duration);
            response = OpenStream::ApiResponse{200, MakeSample(request.path)};
            return;
        }
        ++controls;
        response = request.path == "/refused"
            ? OpenStream::ApiResponse{403, Core::JsonText::FromTrusted(R"({"err_code":-38500})")}
            : OpenStream::ApiResponse{};
    }

    /// "/big" is 16 KiB, "/path…" says its own path, any other counts.
    [[nodiscard]] Core::JsonText MakeSample(const std::string& path) const
    {
        if (path == "/big")
        {
            constexpr std::size_t BIG = 16U * 1024U;
            return Core::JsonText::FromString(std::string(BIG, 'b'));
        }
        return path.starts_with("/path") ? Core::JsonText::FromString(path) : Core::JsonText::FromInteger(gets);
    }

    void StopControl(Core::Now /*now*/) override
    {
        ++stops;
    }
};

/// A server on a free port, and what the tests need around it.
class TcpFixture
{
public:
    boost::asio::io_context context;
    SteadySystemClock clock;
    SeededRandom random;
    RecordingLogSink log;
    CountingService service;
    std::vector<OpenStream::ClientEvent> events;

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamServer> MakeServer(
        const OpenStreamAsio::OpenStreamServerOptions& options)
    {
        return std::make_unique<OpenStreamAsio::OpenStreamServer>(
            context.get_executor(),
            clock,
            Core::Logger(log, "server"),
            options,
            service);
    }

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamServer> StartServer(
        const OpenStreamAsio::OpenStreamServerOptions& options = MakeOptions())
    {
        std::unique_ptr<OpenStreamAsio::OpenStreamServer> server = MakeServer(options);
        const auto started = server->Start();
        REQUIRE(started.has_value());
        REQUIRE(server->GetPort() != 0);
        return server;
    }

    [[nodiscard]] static OpenStreamAsio::OpenStreamServerOptions MakeOptions()
    {
        OpenStreamAsio::OpenStreamServerOptions options;
        options.port = 0;
        return options;
    }

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeClient(std::uint16_t port)
    {
        OpenStreamAsio::OpenStreamClientOptions options;
        options.port = port;
        options.session.controlWindow = std::chrono::milliseconds(100);
        options.session.reconnect.initial = std::chrono::milliseconds(20);
        options.session.reconnect.maximum = std::chrono::milliseconds(50);
        return std::make_unique<OpenStreamAsio::OpenStreamClient>(
            context.get_executor(),
            clock,
            random,
            Core::Logger(log, "client"),
            options,
            [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) { events.push_back(event); });
    }

    /// Runs handlers until the condition holds; false where it did not in time.
    [[nodiscard]] bool TryRunUntil(const std::function<bool()>& isReached)
    {
        const auto end = std::chrono::steady_clock::now() + LIMIT;
        while (!isReached() && std::chrono::steady_clock::now() < end)
        {
            context.restart();
            context.run_one_for(std::chrono::milliseconds(100));
        }
        return isReached();
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(events, [](const OpenStream::ClientEvent& event) {
            return std::holds_alternative<TEvent>(event);
        }));
    }
};

/// A plain socket, as any client in any language has it.
class RawPeer
{
    /// Outlives the peer in the handler that its end aborts.
    struct Reader : std::enable_shared_from_this<Reader>
    {
        boost::asio::ip::tcp::socket socket;
        std::string received;
        std::array<char, 4096> input{};
        bool bClosed = false;

        explicit Reader(boost::asio::io_context& context)
            : socket(context)
        {
        }

        void ReadAsync()
        {
            socket.async_read_some(boost::asio::buffer(input), std::bind_front(&Reader::OnRead, shared_from_this()));
        }

        void OnRead(const boost::system::error_code& error, std::size_t size)
        {
            bClosed = static_cast<bool>(error);
            received.append(input.data(), size);
            if (!error)
            {
                ReadAsync();
            }
        }
    };

    TcpFixture& _fixture;
    std::shared_ptr<Reader> _reader;

public:
    RawPeer(TcpFixture& fixture, std::uint16_t port)
        : RawPeer(fixture, port, 0)
    {
        Read();
    }

    /// With a receive buffer of that many bytes, 0 for the system's own; reads nothing before Read.
    RawPeer(TcpFixture& fixture, std::uint16_t port, int receiveBuffer)
        : _fixture(fixture),
          _reader(std::make_shared<Reader>(fixture.context))
    {
        const boost::asio::ip::tcp::endpoint server(boost::asio::ip::address_v4::loopback(), port);
        _reader->socket.open(server.protocol());
        if (receiveBuffer != 0)
        {
            _reader->socket.set_option(boost::asio::socket_base::receive_buffer_size(receiveBuffer));
        }
        _reader->socket.connect(server);
    }

    void Read()
    {
        _reader->ReadAsync();
    }

    RawPeer(const RawPeer&) = delete;
    RawPeer& operator=(const RawPeer&) = delete;

    ~RawPeer()
    {
        boost::system::error_code ignored;
        static_cast<void>(_reader->socket.close(ignored));
    }

    void Send(std::string_view bytes)
    {
        boost::asio::write(_reader->socket, boost::asio::buffer(bytes));
    }

    void CloseSending()
    {
        _reader->socket.shutdown(boost::asio::ip::tcp::socket::shutdown_send);
    }

    [[nodiscard]] bool TryAwait(std::string_view part)
    {
        return _fixture.TryRunUntil([this, part]() { return _reader->received.find(part) != std::string::npos; });
    }

    /// As many lines with this in them.
    [[nodiscard]] bool TryAwaitCount(std::string_view part, std::size_t count)
    {
        return _fixture.TryRunUntil([this, part, count]() { return CountLines(part) >= count; });
    }

    [[nodiscard]] std::size_t CountLines(std::string_view part) const
    {
        std::size_t count = 0;
        for (const std::string& line : GetLines())
        {
            count += line.find(part) == std::string::npos ? 0U : 1U;
        }
        return count;
    }

    /// The whole lines so far.
    [[nodiscard]] std::vector<std::string> GetLines() const
    {
        std::vector<std::string> lines;
        std::string_view rest = _reader->received;
        for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n'))
        {
            lines.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        return lines;
    }

    [[nodiscard]] bool TryAwaitClose()
    {
        return _fixture.TryRunUntil([this]() { return _reader->bClosed; });
    }

    [[nodiscard]] const std::string& GetReceived() const
    {
        return _reader->received;
    }
};

} // namespace ACS::Testing
