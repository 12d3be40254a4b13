#pragma once

#include "common/LogThinner.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// Counts what robots and arms do that they should not, by robot and kind, and tells it in the log, thinned. Kinds are a
/// fixed set of words in code; robots are those of the configuration.
class OddityLog final
{
public:
    using Key = std::pair<std::string, std::string>; ///< robotID, kind

private:
    const Core::IClock& _clock;
    Apps::LogThinner _log;
    std::map<Key, std::uint64_t> _counts;

public:
    /// The clock must outlive the log.
    OddityLog(Core::Logger logger, const Core::IClock& clock);

    void Note(const std::string& robotID, std::string_view kind, std::string_view detail);

    [[nodiscard]] const std::map<Key, std::uint64_t>& GetCounts() const noexcept;
};

} // namespace ACS::Acsd
