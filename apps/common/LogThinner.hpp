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

/// Writes lines that somebody else can make come in a flood: of each kind the first few, then one per interval, which says
/// how many like it were left out since. A kind of which none has come for an interval begins anew. Pure.
class LogThinner final
{
    struct Run
    {
        std::size_t told = 0;
        std::uint64_t leftOut = 0;
        Core::SteadyTime lastTold;
        Core::SteadyTime lastSeen;
    };

    Core::Logger _logger;
    std::size_t _few;
    std::map<std::string, Run, std::less<>> _runs; ///< By kind.

public:
    static constexpr std::size_t FEW = 5;
    static constexpr std::chrono::seconds INTERVAL{60};
    /// Of kinds at a time, so that nobody fills the memory with them: all further ones count as one.
    static constexpr std::size_t MOST_KINDS = 500;

    explicit LogThinner(Core::Logger logger, std::size_t few = FEW);

    /// What makes lines alike is the caller's to say, whatever their fields: "refused" and the reason without its numbers.
    void Write(
        Core::SteadyTime now,
        Core::ELogLevel level,
        std::string_view kind,
        std::string_view message,
        std::initializer_list<Core::LogField> fields);

private:
    [[nodiscard]] Run& FindRun(Core::SteadyTime now, std::string_view kind);
};

} // namespace ACS::Apps
