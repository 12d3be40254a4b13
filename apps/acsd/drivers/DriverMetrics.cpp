#include "drivers/DriverMetrics.hpp"

#include <utility>

namespace ACS::Acsd
{

DriverMetrics::DriverMetrics(Apps::MetricsEndpoint& endpoint, std::string prefix, const std::string& robotID)
    : _endpoint(endpoint),
      _prefix(std::move(prefix)),
      _labels{{"robot", robotID}}
{
}

void DriverMetrics::AddCounter(const std::string& name, const std::string& help)
{
    _endpoint.AddCounter(GetFullName(name), help);
}

void DriverMetrics::AddGauge(const std::string& name, const std::string& help)
{
    _endpoint.AddGauge(GetFullName(name), help);
}

void DriverMetrics::Increment(const std::string& name, const Labels& labels)
{
    Apps::MetricsEndpoint::Labels all = labels;
    all.insert(_labels.begin(), _labels.end());
    _endpoint.Increment(GetFullName(name), all);
}

void DriverMetrics::SetTotal(const std::string& name, double total)
{
    _endpoint.SetTotal(GetFullName(name), _labels, total);
}

void DriverMetrics::SetGauge(const std::string& name, double value)
{
    _endpoint.SetGauge(GetFullName(name), _labels, value);
}

std::string DriverMetrics::GetFullName(const std::string& name) const
{
    return _prefix + name;
}

} // namespace ACS::Acsd
