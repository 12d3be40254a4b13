#include "TransportLog.hpp"

#include <fmt/format.h>

#include <chrono>
#include <numeric>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

TransportLog::TransportLog(const Floor& floor, std::uint64_t seed, std::size_t count, std::uint64_t priorities)
    : _router(floor.site),
      _demands(MakeDemands(floor, seed, count, priorities))
{
}

bool TransportLog::HasMore() const noexcept
{
    return _submitted < _demands.size();
}

bool TransportLog::IsDone() const noexcept
{
    return !HasMore() && _open.empty();
}

std::size_t TransportLog::CountOpen() const noexcept
{
    return _open.size();
}

Plan TransportLog::Submit(Core::SteadyTime now)
{
    const Demand& demand = _demands[_submitted];
    const std::string planID = fmt::format("P{}", _submitted + 1);
    _open[planID] = {_submitted, now, {}, 0};
    ++_submitted;
    return {
        planID,
        "",
        demand.priority,
        {{1, "CassetteLoad", demand.from, {"C"}, {{planID + "-1", demand.from, "AMR.CP01"}}},
         {2, "CassetteUnload", demand.to, {"C"}, {{planID + "-2", "AMR.CP01", demand.to}}}}};
}

void TransportLog::Begin(const std::string& planID, const std::string& nodeID, Core::SteadyTime now)
{
    Transport& transport = _open.at(planID);
    const Demand& demand = _demands[transport.demand];
    const std::string from = MakeDockID(demand.from);
    transport.begin = now;
    transport.idealSeconds =
        GetSeconds(nodeID, from) + GetSeconds(from, MakeDockID(demand.to)) + demand.loadSeconds + demand.unloadSeconds;
}

void TransportLog::Complete(const std::string& planID, Core::SteadyTime now)
{
    const Transport& transport = _open.at(planID);
    const std::chrono::duration<double> taken = now - transport.begin;
    const std::chrono::duration<double> total = now - transport.submitted;
    _finished.push_back({taken.count() / transport.idealSeconds, total.count()});
    _open.erase(planID);
}

const Demand& TransportLog::GetDemand(const std::string& planID) const
{
    return _demands[_open.at(planID).demand];
}

std::vector<std::string> TransportLog::ListOpen() const
{
    std::vector<std::string> planIDs;
    for (const auto& [planID, transport] : _open)
    {
        planIDs.push_back(planID);
    }
    return planIDs;
}

const std::vector<FinishedTransport>& TransportLog::GetFinished() const noexcept
{
    return _finished;
}

double TransportLog::GetMeanSlowdown() const
{
    const double sum =
        std::accumulate(_finished.begin(), _finished.end(), 0.0, [](double before, const FinishedTransport& transport) {
            return before + transport.slowdown;
        });
    return sum / static_cast<double>(_finished.size());
}

/// On an empty floor.
double TransportLog::GetSeconds(const std::string& from, const std::string& to) const
{
    return _router.FindRouteOrNull(FLEET_TYPE, from, to)->travelSeconds;
}

} // namespace ACS::Testing
