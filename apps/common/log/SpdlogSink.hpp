#pragma once

#include <acs/core/Logger.hpp>

#include <initializer_list>
#include <memory>
#include <string_view>

namespace ACS::Apps
{

/// Writes one line per event to standard error: UTC time, level, component, message, fields (see LogText.hpp).
/// Uses no global logger of spdlog.
class SpdlogSink final : public Core::ILogSink
{
    struct Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// Lines below the level are dropped.
    explicit SpdlogSink(Core::ELogLevel level);
    SpdlogSink(const SpdlogSink&) = delete;
    SpdlogSink& operator=(const SpdlogSink&) = delete;
    ~SpdlogSink() override;

    void SetLevel(Core::ELogLevel level);

    [[nodiscard]] bool ShouldWrite(Core::ELogLevel level) const override;
    void Write(
        Core::ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<Core::LogField> fields) override;
};

} // namespace ACS::Apps
