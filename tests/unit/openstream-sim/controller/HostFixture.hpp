#pragma once

#include "Catch.hpp"
#include "common/process/SystemClock.hpp"
#include "controller/ControllerHost.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <boost/asio/buffers_iterator.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Testing
{

inline constexpr std::chrono::seconds LIMIT{10};

/// A controller on free ports, ten times as fast as real time by default, and an Open Stream client of it.
class HostFixture final
{
    Apps::SystemClock _clock;
    Testing::SeededRandom _random;
    Testing::RecordingLogSink _log;

public:
    boost::asio::io_context context;
    std::vector<OpenStream::ClientEvent> events;
    std::unique_ptr<OpenStreamSim::ControllerHost> host;
    std::unique_ptr<OpenStreamAsio::OpenStreamClient> client;

    explicit HostFixture(
        const OpenStream::ClientSessionOptions& sessionOptions = {},
        const OpenStreamSim::ControllerOptions& controller = MakeFastOptions())
    {
        OpenStreamSim::HostOptions options;
        options.stream.port = 0;
        options.http.port = 0;
        options.controller = controller;
        host = MakeHost(options);
        REQUIRE(host->Start().has_value());

        OpenStreamAsio::OpenStreamClientOptions clientOptions;
        clientOptions.session = sessionOptions;
        clientOptions.session.reconnect.initial = std::chrono::milliseconds(20);
        clientOptions.port = host->GetStreamEndpoint().port;
        clientOptions.session.controlWindow = std::chrono::milliseconds(50);
        client = std::make_unique<OpenStreamAsio::OpenStreamClient>(
            context.get_executor(),
            _clock,
            _random,
            Core::Logger(_log, "client"),
            clientOptions,
            [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) { events.push_back(event); });
        client->Start();
    }

    [[nodiscard]] static OpenStreamSim::ControllerOptions MakeFastOptions()
    {
        OpenStreamSim::ControllerOptions options;
        options.timeScale = 10.0;
        return options;
    }

    [[nodiscard]] std::unique_ptr<OpenStreamSim::ControllerHost> MakeHost(const OpenStreamSim::HostOptions& options)
    {
        return std::make_unique<OpenStreamSim::ControllerHost>(
            context.get_executor(),
            _clock,
            Core::Logger(_log, "sim"),
            options);
    }

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

    void Monitor(const char* url, const char* args, std::chrono::milliseconds period = std::chrono::milliseconds(10))
        const
    {
        client->SetMonitor(OpenStream::MonitorRequest{url, period, Core::JsonText::FromTrusted(args), {}});
    }

    /// The text of the newest sample; empty if there is none.
    [[nodiscard]] std::string GetSample() const
    {
        std::string sample;
        for (const OpenStream::ClientEvent& event : events)
        {
            const auto* const dataOrNull = std::get_if<OpenStream::ClientData>(&event);
            if (dataOrNull != nullptr)
            {
                sample = dataOrNull->line.result.value_or(Core::JsonText()).GetText();
            }
        }
        return sample;
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(events, [](const OpenStream::ClientEvent& event) {
            return std::holds_alternative<TEvent>(event);
        }));
    }

    template <typename TEvent>
    [[nodiscard]] bool TryAwaitCount(std::size_t count)
    {
        return TryRunUntil([this, count]() { return Count<TEvent>() >= count; });
    }

    /// The newest of its kind; there must be one.
    template <typename TEvent>
    [[nodiscard]] const TEvent& GetLast() const
    {
        const TEvent* last = nullptr;
        for (const OpenStream::ClientEvent& event : events)
        {
            const auto* const found = std::get_if<TEvent>(&event);
            last = found != nullptr ? found : last;
        }
        REQUIRE(last != nullptr);
        return *last;
    }

    void Begin(std::string_view text) const
    {
        const auto fault = Apps::ParseFault(OpenStreamSim::GetFaultGrammar(), text);
        REQUIRE(fault.has_value());
        REQUIRE(host->TryAddFault(*fault));
    }

    [[nodiscard]] bool TryAwaitSample(const std::string& text)
    {
        return TryRunUntil([this, &text]() { return GetSample() == text; });
    }

    /// Result of the CONTROL.
    [[nodiscard]] OpenStream::ClientControlSettled Control(const char* url, const char* body)
    {
        const std::uint64_t token = client->SendControl(
            OpenStream::ControlRequest{OpenStream::EApiMethod::Post, url, {}, Core::JsonText::FromTrusted(body)},
            OpenStream::EControlTracking::Tracked);
        OpenStream::ClientControlSettled settled;
        const auto isSettled = [&]() {
            for (const OpenStream::ClientEvent& event : events)
            {
                const auto* const settledOrNull = std::get_if<OpenStream::ClientControlSettled>(&event);
                if (settledOrNull != nullptr && settledOrNull->token == token)
                {
                    settled = *settledOrNull;
                    return true;
                }
            }
            return false;
        };
        REQUIRE(TryRunUntil(isSettled));
        return settled;
    }

    /// The whole answer to bytes that were sent on a connection of their own.
    [[nodiscard]] std::string SendHTTP(const std::string& request)
    {
        return Send(host->GetHttpEndpoint().port, request);
    }

    /// The lines that another Open Stream client gets, which sends these lines, then STOP session.
    [[nodiscard]] std::string SendLines(const std::string& lines)
    {
        const std::string handshake = R"({"cmd":"HANDSHAKE","payload":{"major":1}})";
        const std::string end = R"({"cmd":"STOP","payload":{"target":"session"}})";
        return Send(host->GetStreamEndpoint().port, handshake + "\n" + lines + end + "\n");
    }

    [[nodiscard]] std::string GetOverHTTP(const std::string& target)
    {
        return SendHTTP("GET " + target + " HTTP/1.1\r\nHost: sim\r\nConnection: close\r\n\r\n");
    }

    [[nodiscard]] std::string PostOverHTTP(const std::string& target, const std::string& body)
    {
        return SendHTTP(
            "POST " + target + " HTTP/1.1\r\nHost: sim\r\nConnection: close\r\nContent-Length: "
            + std::to_string(body.size()) + "\r\n\r\n" + body);
    }

private:
    [[nodiscard]] std::string Send(std::uint16_t port, const std::string& request)
    {
        boost::asio::ip::tcp::socket socket(context);
        socket.connect({boost::asio::ip::address_v4::loopback(), port});
        boost::asio::write(socket, boost::asio::buffer(request));
        std::string answer;
        bool bEnded = false;
        boost::asio::async_read(
            socket,
            boost::asio::dynamic_buffer(answer),
            [&bEnded](const boost::system::error_code&, std::size_t) { bEnded = true; });
        const bool bInTime = TryRunUntil([&bEnded]() { return bEnded; });
        if (!bInTime)
        {
            socket.close();
            context.restart();
            context.poll();
        }
        REQUIRE(bInTime);
        return answer;
    }
};

} // namespace ACS::Testing
