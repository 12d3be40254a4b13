#pragma once

#include <acs/core/Api.hpp>

#include <map>
#include <string>

namespace ACS::Acsd
{

/// The metrics of one robot at /metrics. A name has a-z and _ only. acsd serves it as `acsd_driver_DRIVER_NAME` with the label
/// `robot`; the name of a counter ends in `_total`.
class ACS_API IRobotMetrics
{
public:
    /// Value by name of the label, which has a-z and _ only.
    using Labels = std::map<std::string, std::string>;

    IRobotMetrics() = default;
    IRobotMetrics(const IRobotMetrics&) = delete;
    IRobotMetrics& operator=(const IRobotMetrics&) = delete;
    virtual ~IRobotMetrics() = default;

    /// Adds a metric with its help text. Further calls for the same name are ignored.
    virtual void AddCounter(const std::string& name, const std::string& help) = 0;
    /// Likewise, for a value that goes up and down.
    virtual void AddGauge(const std::string& name, const std::string& help) = 0;

    // The metrics must have been added.

    /// Adds 1 to a counter. The labels are besides `robot`, mostly none; give them few values, because each combination is a metric.
    virtual void Increment(const std::string& name, const Labels& labels) = 0;
    /// Raises a counter to a total that is counted elsewhere; a smaller total is ignored.
    virtual void SetTotal(const std::string& name, double total) = 0;
    /// Sets a gauge to the value.
    virtual void SetGauge(const std::string& name, double value) = 0;
};

} // namespace ACS::Acsd
