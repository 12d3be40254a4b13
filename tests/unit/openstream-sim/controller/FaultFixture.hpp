#pragma once

#include "api/FaultyService.hpp"
#include "Catch.hpp"
#include "controller/ControllerFaults.hpp"
#include "controller/VirtualController.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/openstream/ApiRequest.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

/// A controller with faults and both of its interfaces, on a clock that the test advances.
class FaultFixture final : public OpenStreamSim::IFaultHost
{
    RecordingLogSink _log;

public:
    ManualClock clock;

private:
    OpenStreamSim::VirtualController _controller;
    std::optional<OpenStreamSim::ControllerFaults> _faults;
    std::optional<OpenStreamSim::FaultyService> _stream;
    std::optional<OpenStreamSim::FaultyService> _http;

public:
    int drops = 0;
    std::optional<Core::SteadyTime> wakeAt;
    OpenStream::ApiResponse response; ///< Of the last call.

    explicit FaultFixture(const OpenStreamSim::ControllerOptions& options = MakeOptions())
        : _controller(options, clock.GetNow(), Core::Logger(_log, "controller"))
    {
        _faults.emplace(_controller, *this, Core::Logger(_log, "controller"), clock.GetNow());
        _stream.emplace(_controller, *_faults, OpenStreamSim::EFaultSide::Stream);
        _http.emplace(_controller, *_faults, OpenStreamSim::EFaultSide::Http);
    }

    [[nodiscard]] static OpenStreamSim::ControllerOptions MakeOptions()
    {
        OpenStreamSim::ControllerOptions options;
        options.bMotorOn = true;
        return options;
    }

    void Begin(std::string_view text)
    {
        const auto fault = Apps::ParseFault(OpenStreamSim::GetFaultGrammar(), text);
        REQUIRE(fault.has_value());
        REQUIRE(_faults->TryAdd(*fault, clock.GetNow()));
    }

    [[nodiscard]] bool TryBegin(const OpenStreamSim::Fault& fault)
    {
        return _faults->TryAdd(fault, clock.GetNow());
    }

    /// "+estop for=5s", "-estop for=5s its time is over" of the log.
    [[nodiscard]] std::vector<std::string> GetChanges() const
    {
        std::vector<std::string> changes;
        for (const RecordedLine& line : _log.GetLines())
        {
            if (line.message == "fault begins")
            {
                changes.push_back("+" + line.fields.at(0).second);
            }
            if (line.message == "fault ended")
            {
                changes.push_back("-" + line.fields.at(0).second + " " + line.fields.at(1).second);
            }
        }
        return changes;
    }

    std::size_t End(std::optional<OpenStreamSim::EFaultKind> kindOrNull = std::nullopt)
    {
        return _faults->End(kindOrNull, clock.GetNow());
    }

    /// Advances the time and fires each timer when it is due, as a host does.
    void Pass(std::chrono::milliseconds span)
    {
        const Core::SteadyTime end = clock.GetNow().steady + span;
        while (wakeAt.has_value() && *wakeAt <= end)
        {
            clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(*wakeAt - clock.GetNow().steady));
            wakeAt.reset();
            _faults->OnTimer(clock.GetNow());
        }
        clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(end - clock.GetNow().steady));
    }

    /// The sample that a MONITOR gets at a tick; empty if no line is sent.
    std::string Sample(std::string_view url)
    {
        Call(*_stream, OpenStream::EApiMethod::Get, url, {});
        return response.bNoSample ? std::string() : response.body.value_or(Core::JsonText()).GetText();
    }

    /// The status of a CONTROL.
    int Control(std::string_view url, std::string body = "{}")
    {
        Call(*_stream, OpenStream::EApiMethod::Post, url, std::move(body));
        return response.status;
    }

    std::string GetOverHTTP(std::string_view url)
    {
        Call(*_http, OpenStream::EApiMethod::Get, url, {});
        return response.body.value_or(Core::JsonText()).GetText();
    }

    int PostOverHTTP(std::string_view url, std::string body = "{}")
    {
        Call(*_http, OpenStream::EApiMethod::Post, url, std::move(body));
        return response.status;
    }

    void CallStream(const OpenStream::ApiRequest& request, OpenStream::ApiResponse& answer)
    {
        _stream->Call(request, clock.GetNow(), answer);
    }

    int StartProgram(int number)
    {
        const std::string body = R"({"ext_sel":1,"pno":)" + std::to_string(number) + "}";
        REQUIRE(PostOverHTTP("/project/context/tasks[0]/set_cur_pc_idx", R"({"idx":1})") == 200);
        REQUIRE(PostOverHTTP("/project/context/tasks[0]/cur_prog_cnt", body) == 200);
        return PostOverHTTP("/project/robot/start");
    }

    /// Started, finished, failed and the number of the last program.
    std::string GetCounters()
    {
        return GetOverHTTP("/project/plc/m/val_s32?st=400&len=4");
    }

    /// The member of /project/robot.
    bool ContainsInRobot(std::string_view member)
    {
        return GetOverHTTP("/project/robot").find(member) != std::string::npos;
    }

private:
    void DropSessions() override
    {
        ++drops;
    }

    void WakeAt(std::optional<Core::SteadyTime> timeOrNull) override
    {
        wakeAt = timeOrNull;
    }
    void Call(
        OpenStreamSim::FaultyService& service,
        OpenStream::EApiMethod method,
        std::string_view url,
        std::string body)
    {
        OpenStream::ApiRequest request;
        request.method = method;
        OpenStream::SplitURL(url, request);
        if (method != OpenStream::EApiMethod::Get)
        {
            request.body = Core::JsonText::FromTrusted(std::move(body));
        }
        service.Call(request, clock.GetNow(), response);
    }
};

} // namespace ACS::Testing
