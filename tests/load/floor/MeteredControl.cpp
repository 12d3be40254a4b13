#include "MeteredControl.hpp"

#include <ctime>
#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

double GetProcessorSeconds()
{
    constexpr double NANOSECONDS = 1e9;
    std::timespec time{};
    static_cast<void>(clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time));
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / NANOSECONDS;
}

/// Adds the processor time until its end.
class Meter
{
    double& _seconds;
    double _begin = GetProcessorSeconds();

public:
    explicit Meter(double& seconds)
        : _seconds(seconds)
    {
    }

    Meter(const Meter&) = delete;
    Meter& operator=(const Meter&) = delete;

    ~Meter()
    {
        _seconds += GetProcessorSeconds() - _begin;
    }
};

} // namespace

MeteredControl::MeteredControl(std::unique_ptr<IFleetControl> control, double& seconds)
    : _control(std::move(control)),
      _seconds(seconds)
{
}

void MeteredControl::Submit(Plan plan, std::uint64_t number, Core::Now now, EngineActions& out)
{
    const Meter meter(_seconds);
    _control->Submit(std::move(plan), number, now, out);
}

void MeteredControl::OnEvent(const std::string& robotID, const RobotEvent& event, Core::Now now, EngineActions& out)
{
    const Meter meter(_seconds);
    _control->OnEvent(robotID, event, now, out);
}

void MeteredControl::OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out)
{
    const Meter meter(_seconds);
    _control->OnTimer(timer, now, out);
}

void MeteredControl::OnStored(Core::Now now, EngineActions& out)
{
    const Meter meter(_seconds);
    _control->OnStored(now, out);
}

void MeteredControl::OnReportSent(std::uint64_t sequence, Core::Now now, EngineActions& out)
{
    const Meter meter(_seconds);
    _control->OnReportSent(sequence, now, out);
}

std::optional<std::string> MeteredControl::GetRobotIDOrNull(const std::string& planID) const
{
    return _control->GetRobotIDOrNull(planID);
}

} // namespace ACS::Testing
