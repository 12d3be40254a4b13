#include "common/http/MetricsEndpoint.hpp"

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <cassert>
#include <map>
#include <string>
#include <unordered_map>

namespace ACS::Apps
{

namespace
{

constexpr const char* EXPOSITION_TYPE = "text/plain; version=0.0.4; charset=utf-8";

template <typename TMetric>
using FamilyMap = std::unordered_map<std::string, prometheus::Family<TMetric>*>;

/// The metric of that name and those labels; created at its first use.
template <typename TMetric>
TMetric& GetMetric(FamilyMap<TMetric>& families, const std::string& name, const MetricsEndpoint::Labels& labels)
{
    const auto found = families.find(name);
    assert(found != families.end() && "metric was not added");
    return found->second->Add(labels);
}

} // namespace

struct MetricsEndpoint::Impl
{
    prometheus::Registry registry;
    FamilyMap<prometheus::Counter> counters;
    FamilyMap<prometheus::Gauge> gauges;
    FamilyMap<prometheus::Histogram> histograms;
    std::unordered_map<std::string, prometheus::Histogram::BucketBoundaries> bounds;
    std::unordered_map<std::string, std::map<Labels, prometheus::Gauge*>> replaced; ///< The series of ReplaceGauges.

    prometheus::Histogram& GetHistogram(const std::string& name, const Labels& labels)
    {
        const auto found = histograms.find(name);
        assert(found != histograms.end() && "metric was not added");
        return found->second->Add(labels, bounds.at(name));
    }
};

MetricsEndpoint::MetricsEndpoint()
    : _impl(std::make_unique<Impl>())
{
}

MetricsEndpoint::~MetricsEndpoint() = default;

void MetricsEndpoint::AddCounter(const std::string& name, const std::string& help)
{
    if (_impl->counters.find(name) == _impl->counters.end())
    {
        _impl->counters.emplace(name, &prometheus::BuildCounter().Name(name).Help(help).Register(_impl->registry));
    }
}

void MetricsEndpoint::AddGauge(const std::string& name, const std::string& help)
{
    if (_impl->gauges.find(name) == _impl->gauges.end())
    {
        _impl->gauges.emplace(name, &prometheus::BuildGauge().Name(name).Help(help).Register(_impl->registry));
    }
}

void MetricsEndpoint::AddHistogram(const std::string& name, const std::string& help, const std::vector<double>& bounds)
{
    if (_impl->histograms.find(name) == _impl->histograms.end())
    {
        _impl->histograms.emplace(name, &prometheus::BuildHistogram().Name(name).Help(help).Register(_impl->registry));
        _impl->bounds.emplace(name, bounds);
    }
}

void MetricsEndpoint::Observe(const std::string& name, const Labels& labels, double value)
{
    _impl->GetHistogram(name, labels).Observe(value);
}

void MetricsEndpoint::Increment(const std::string& name, const Labels& labels, double delta)
{
    GetMetric(_impl->counters, name, labels).Increment(delta);
}

void MetricsEndpoint::SetTotal(const std::string& name, const Labels& labels, double total)
{
    prometheus::Counter& counter = GetMetric(_impl->counters, name, labels);
    if (total > counter.Value())
    {
        counter.Increment(total - counter.Value());
    }
}

void MetricsEndpoint::SetGauge(const std::string& name, const Labels& labels, double value)
{
    GetMetric(_impl->gauges, name, labels).Set(value);
}

void MetricsEndpoint::ReplaceGauges(const std::string& name, const Series& series)
{
    std::map<Labels, prometheus::Gauge*>& present = _impl->replaced[name];
    std::erase_if(present, [this, &name, &series](const auto& gauge) {
        const bool bGone = !series.contains(gauge.first);
        if (bGone)
        {
            _impl->gauges.at(name)->Remove(gauge.second);
        }
        return bGone;
    });
    for (const auto& [labels, value] : series)
    {
        prometheus::Gauge& gauge = GetMetric(_impl->gauges, name, labels);
        gauge.Set(value);
        present.insert_or_assign(labels, &gauge);
    }
}

void MetricsEndpoint::CreateCounter(const std::string& name, const Labels& labels)
{
    GetMetric(_impl->counters, name, labels);
}

void MetricsEndpoint::CreateHistogram(const std::string& name, const Labels& labels)
{
    _impl->GetHistogram(name, labels);
}

std::string MetricsEndpoint::Render() const
{
    return prometheus::TextSerializer().Serialize(_impl->registry.Collect());
}

HttpResponse MetricsEndpoint::Respond() const
{
    HttpResponse response;
    response.contentType = EXPOSITION_TYPE;
    response.body = Render();
    return response;
}

} // namespace ACS::Apps
