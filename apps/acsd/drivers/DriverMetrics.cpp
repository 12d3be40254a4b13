#include "drivers/DriverMetrics.hpp"

#include <fmt/format.h>

namespace ACS::Acsd
{

DriverMetrics::DriverMetrics(Apps::MetricsEndpoint& endpoint, const std::string& driver, const std::string& robotID)
    : _endpoint(endpoint),
      _prefix(fmt::format("acsd_driver_{}_", driver)),
      _labels{{"robot", robotID}}
{
}

void DriverMetrics::AddCounter(const std::string& name, const std::string& help)
{
    _endpoint.AddCounter(_prefix + name, help);
}

void DriverMetrics::AddGauge(const std::string& name, const std::string& help)
{
    _endpoint.AddGauge(_prefix + name, help);
}

void DriverMetrics::SetTotal(const std::string& name, double total)
{
    _endpoint.SetTotal(_prefix + name, _labels, total);
}

void DriverMetrics::SetGauge(const std::string& name, double value)
{
    _endpoint.SetGauge(_prefix + name, _labels, value);
}

} // namespace ACS::Acsd
