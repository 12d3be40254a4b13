#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/IOpenApiService.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace ACS::Testing
{

/// Counts its calls, and answers after a configurable time.
class CountingService final : public OpenStream::IOpenApiService
{
public:
    int gets = 0;
    int controls = 0;
    int stops = 0;
    std::chrono::milliseconds duration{0}; ///< Of a call: how slow the service is.
    std::chrono::milliseconds delay{0};    ///< Of an answer, without blocking the server.

    void Call(const OpenStream::ApiRequest& request, Core::Now /*now*/, OpenStream::ApiResponse& response) override
    {
        if (request.method == OpenStream::EApiMethod::Get)
        {
            ++gets;
            Work();
            response = OpenStream::ApiResponse{200, MakeSample(request.path)};
            response.delay = delay;
            return;
        }
        ++controls;
        response = request.path == "/refused"
            ? OpenStream::ApiResponse{403, Core::JsonText::FromTrusted(R"({"err_code":-38500})")}
            : OpenStream::ApiResponse{};
        response.delay = delay;
    }

    /// Blocks the server's thread.
    void Work() const
    {
        const auto end = std::chrono::steady_clock::now() + duration;
        while (std::chrono::steady_clock::now() < end)
        {
        }
    }

    /// "/big" is 16 KiB, "/path…" is answered with its path, any other with a count.
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

} // namespace ACS::Testing
