#pragma once

#include "common/http/HttpMessage.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Apps
{

/// Counters, gauges and histograms of one program, served as Prometheus text. Names and label names match
/// [a-zA-Z_][a-zA-Z0-9_]*; label values may be any text.
class MetricsEndpoint final
{
public:
    using Labels = std::map<std::string, std::string>;
    /// One series of a gauge for each set of labels.
    using Series = std::map<Labels, double>;

private:
    struct Impl;

    std::unique_ptr<Impl> _impl;

public:
    MetricsEndpoint();
    MetricsEndpoint(const MetricsEndpoint&) = delete;
    MetricsEndpoint& operator=(const MetricsEndpoint&) = delete;
    ~MetricsEndpoint();

    /// Adds a metric with its help text. Further calls for the same name are ignored.
    void AddCounter(const std::string& name, const std::string& help);
    void AddGauge(const std::string& name, const std::string& help);
    /// bounds: upper bounds of the buckets, ascending; the last bucket has none.
    void AddHistogram(const std::string& name, const std::string& help, const std::vector<double>& bounds);

    // The metrics must have been added.

    void Increment(const std::string& name, const Labels& labels = {}, double delta = 1.0);
    /// Raises a counter to a total that is counted elsewhere; a smaller total is ignored.
    void SetTotal(const std::string& name, const Labels& labels, double total);
    void Observe(const std::string& name, const Labels& labels, double value);
    void SetGauge(const std::string& name, const Labels& labels, double value);
    /// Sets these series of the gauge and removes all others.
    void ReplaceGauges(const std::string& name, const Series& series);
    /// Creates the series with the value 0 if it does not exist: a rate needs the value before the first event.
    void CreateCounter(const std::string& name, const Labels& labels = {});
    void CreateHistogram(const std::string& name, const Labels& labels = {});

    /// All metrics in the Prometheus text format.
    [[nodiscard]] std::string Render() const;

    /// The response to GET /metrics.
    [[nodiscard]] HttpResponse Respond() const;
};

} // namespace ACS::Apps
