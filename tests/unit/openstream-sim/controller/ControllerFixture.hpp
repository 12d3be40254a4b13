#pragma once

#include "controller/VirtualController.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/openstream/ApiRequest.hpp>

#include <chrono>
#include <string>
#include <string_view>

namespace ACS::Testing
{

/// A VirtualController on a clock that the test advances.
class ControllerFixture final
{
    RecordingLogSink _log;

public:
    ManualClock clock;
    OpenStreamSim::VirtualController controller;

    explicit ControllerFixture(const OpenStreamSim::ControllerOptions& options = {})
        : controller(options, clock.GetNow(), Core::Logger(_log, "controller"))
    {
    }

    [[nodiscard]] static OpenStreamSim::ControllerOptions MakeReadyOptions()
    {
        OpenStreamSim::ControllerOptions options;
        options.bMotorOn = true;
        return options;
    }

    [[nodiscard]] const RecordingLogSink& GetLog() const noexcept
    {
        return _log;
    }

    OpenStream::ApiResponse Call(OpenStream::EApiMethod method, std::string_view url, std::string body = "{}")
    {
        OpenStream::ApiRequest request;
        request.method = method;
        OpenStream::SplitURL(url, request);
        if (method != OpenStream::EApiMethod::Get)
        {
            request.body = Core::JsonText::FromTrusted(std::move(body));
        }
        OpenStream::ApiResponse response;
        controller.Call(request, clock.GetNow(), response);
        return response;
    }

    /// The body of a GET.
    std::string Get(std::string_view url)
    {
        return Call(OpenStream::EApiMethod::Get, url).body.value_or(Core::JsonText()).GetText();
    }

    /// The status of a POST.
    int Post(std::string_view url, std::string body = "{}")
    {
        return Call(OpenStream::EApiMethod::Post, url, std::move(body)).status;
    }

    /// "status err_code" of a POST.
    std::string PostForCode(std::string_view url, std::string body = "{}")
    {
        const OpenStream::ApiResponse response = Call(OpenStream::EApiMethod::Post, url, std::move(body));
        const std::string text = response.body.value_or(Core::JsonText()).GetText();
        constexpr std::string_view KEY = "\"err_code\":";
        const std::size_t key = text.find(KEY);
        const std::size_t begin = key + KEY.size();
        return std::to_string(response.status)
            + (key == std::string::npos ? "" : " " + text.substr(begin, text.find(',', begin) - begin));
    }

    /// As in the manual for remote mode: sets the cursor first, in case a program was started or stopped.
    int Select(int program)
    {
        Post("/project/context/tasks[0]/set_cur_pc_idx", R"({"idx":1})");
        return Post("/project/context/tasks[0]/cur_prog_cnt", R"({"ext_sel":1,"pno":)" + std::to_string(program) + "}");
    }

    /// A reset that controllers before 60.30 also have.
    int Reset()
    {
        return Post("/project/service/r_code/execute", R"({"code":1})");
    }

    int Start()
    {
        return Post("/project/robot/start");
    }

    /// Started, finished, failed and the number of the last program.
    std::string GetCounters()
    {
        return Get("/project/plc/m/val_s32?st=400&len=4");
    }

    bool Contains(std::string_view url, std::string_view part)
    {
        return Get(url).find(part) != std::string::npos;
    }
};

} // namespace ACS::Testing
