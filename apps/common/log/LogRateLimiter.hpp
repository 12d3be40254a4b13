#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Limits the rate of log lines that a peer can trigger. For each kind it writes a burst, then one line per interval with the
/// number of lines that were suppressed since the last one. A kind without lines for an interval gets a new burst.
class LogRateLimiter final
{
public:
    static constexpr std::size_t BURST = 5;
    static constexpr std::chrono::seconds INTERVAL{60};
    /// Limits the memory that a peer can use: further kinds are counted as one until kinds without lines for an interval give way,
    /// whose numbers of suppressed lines are then not written.
    static constexpr std::size_t MAX_KINDS = 500;

private:
    struct Kind
    {
        std::size_t written = 0;
        std::uint64_t suppressed = 0;
        Core::SteadyTime lastWritten;
        Core::SteadyTime lastSeen;
    };

    Core::Logger _logger;
    std::size_t _burst;
    std::map<std::string, Kind, std::less<>> _kinds;

public:
    explicit LogRateLimiter(Core::Logger logger, std::size_t burst = BURST);

    /// Lines of a kind are counted together, independently of their fields. A kind is for example "refused" and the reason
    /// without its numbers.
    void Write(
        Core::SteadyTime now,
        Core::ELogLevel level,
        std::string_view kind,
        std::string_view message,
        std::initializer_list<Core::LogField> fields);

private:
    [[nodiscard]] Kind& FindKind(Core::SteadyTime now, std::string_view kind);
};

} // namespace ACS::Apps
