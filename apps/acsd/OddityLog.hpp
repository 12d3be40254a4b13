#pragma once

#include <acs/core/Logger.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// The first, the tenth, the hundredth…: whoever repeats a mistake does not fill the log. The last `news` of `total` are new.
[[nodiscard]] bool IsWorthALine(std::uint64_t total, std::uint64_t news = 1);

/// Counts what robots and arms do that they should not, by robot and kind, and tells it in the log now and then. Kinds are a
/// fixed set of words in code; robots are those of the configuration.
class OddityLog final
{
public:
    using Key = std::pair<std::string, std::string>; ///< robotID, kind

private:
    Core::Logger _logger;
    std::map<Key, std::uint64_t> _counts;

public:
    explicit OddityLog(Core::Logger logger);

    void Note(const std::string& robotID, std::string_view kind, std::string_view detail);

    [[nodiscard]] const std::map<Key, std::uint64_t>& GetCounts() const noexcept;
};

} // namespace ACS::Acsd
