#pragma once

#include <acs/core/Logger.hpp>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string_view>

namespace ACS::Apps
{

/// What a reader of standard error that does not read can do to the program.
enum class ELogWriting : std::uint8_t
{
    Direct, ///< It stops the program. A line is written when Write returns.
    Queued, ///< It loses lines: see LineWriter.hpp.
};

/// Writes one line per event to standard error: UTC time, level, component, message, fields (see LogText.hpp).
/// Uses no global logger of spdlog.
class SpdlogSink final : public Core::ILogSink
{
    struct Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// Lines below the level are dropped.
    explicit SpdlogSink(Core::ELogLevel level, ELogWriting writing = ELogWriting::Direct);
    SpdlogSink(const SpdlogSink&) = delete;
    SpdlogSink& operator=(const SpdlogSink&) = delete;
    ~SpdlogSink() override;

    void SetLevel(Core::ELogLevel level);
    /// Waits until all lines so far are written, for at most a second.
    void Flush();
    /// Lines that standard error did not take in time.
    [[nodiscard]] std::uint64_t GetDropped() const;

    [[nodiscard]] bool ShouldWrite(Core::ELogLevel level) const override;
    void Write(
        Core::ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<Core::LogField> fields) override;
};

} // namespace ACS::Apps
