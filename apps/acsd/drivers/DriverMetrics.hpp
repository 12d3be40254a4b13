#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include <acs/acsd/IRobotMetrics.hpp>

#include <string>

namespace ACS::Acsd
{

/// The metrics of one robot.
class DriverMetrics final : public IRobotMetrics
{
    Apps::MetricsEndpoint& _endpoint;
    const std::string _prefix; ///< Of each name.
    const Apps::MetricsEndpoint::Labels _labels;

public:
    /// The endpoint must outlive it.
    DriverMetrics(Apps::MetricsEndpoint& endpoint, std::string prefix, const std::string& robotID);

    void AddCounter(const std::string& name, const std::string& help) override;
    void AddGauge(const std::string& name, const std::string& help) override;
    void Increment(const std::string& name, const Labels& labels) override;
    void SetTotal(const std::string& name, double total) override;
    void SetGauge(const std::string& name, double value) override;

private:
    [[nodiscard]] std::string GetFullName(const std::string& name) const;
};

} // namespace ACS::Acsd
