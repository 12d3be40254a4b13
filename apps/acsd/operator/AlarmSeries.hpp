#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include <acs/plan/Report.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The series of the active alarms by robot, code and level. Their number is limited, because vehicles name their errors
/// themselves: each robot has at most MAXIMUM_CODES codes of its own since the start, besides those of acsd; its others count
/// as "other".
class AlarmSeries final
{
public:
    static constexpr std::size_t MAXIMUM_CODES = 20;

private:
    std::map<std::string, std::set<std::string, std::less<>>, std::less<>> _codes; ///< By robotID.

public:
    /// The number of alarms by their labels.
    [[nodiscard]] Apps::MetricsEndpoint::Series Count(const std::vector<Planning::Alarm>& alarms);

private:
    [[nodiscard]] std::string GetCode(const Planning::Alarm& alarm);
};

} // namespace ACS::Acsd
