#include "operator/ProcessMetrics.hpp"

#include "common/Version.hpp"

#include <chrono>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace ACS::Acsd
{

namespace
{

constexpr const char* BUILD_INFO = "acsd_build_info";
constexpr const char* START_TIME = "process_start_time_seconds";
constexpr const char* CPU_SECONDS = "process_cpu_seconds_total";
constexpr const char* MEMORY = "process_resident_memory_bytes";

double GetCpuSeconds()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto count = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    return count(usage.ru_utime) + count(usage.ru_stime);
}

/// 0 if /proc cannot be read.
double GetResidentBytes()
{
    std::ifstream statistics("/proc/self/statm");
    double total = 0;
    double resident = 0;
    statistics >> total >> resident;
    return statistics ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0.0;
}

} // namespace

ProcessMetrics::ProcessMetrics(Apps::MetricsEndpoint& metrics, Core::Now now)
    : _metrics(metrics)
{
    _metrics.AddGauge(BUILD_INFO, "1, with the version as a label");
    _metrics.AddGauge(START_TIME, "Time of the start, in seconds since 1970");
    _metrics.AddCounter(CPU_SECONDS, "CPU time of the process");
    _metrics.AddGauge(MEMORY, "Resident memory of the process");
    _metrics.SetGauge(BUILD_INFO, {{"version", std::string(Apps::VERSION)}}, 1.0);
    const std::chrono::duration<double> start = now.wall.time_since_epoch();
    _metrics.SetGauge(START_TIME, {}, start.count());
}

void ProcessMetrics::Update()
{
    _metrics.SetTotal(CPU_SECONDS, {}, GetCpuSeconds());
    _metrics.SetGauge(MEMORY, {}, GetResidentBytes());
}

} // namespace ACS::Acsd
