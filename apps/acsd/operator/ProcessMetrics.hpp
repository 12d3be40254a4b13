#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include <acs/core/Now.hpp>

namespace ACS::Acsd
{

/// The metrics of the process that Prometheus programs have in common, and the version of acsd.
class ProcessMetrics final
{
    Apps::MetricsEndpoint& _metrics;

public:
    /// Call it at the start of the process, which is now. The endpoint must outlive it.
    ProcessMetrics(Apps::MetricsEndpoint& metrics, Core::Now now);

    void Update();
};

} // namespace ACS::Acsd
