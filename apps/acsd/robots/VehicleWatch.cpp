#include "robots/VehicleWatch.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/FactsheetCheck.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

constexpr const char* ODDITIES = "acsd_robot_oddities_total";
constexpr double HIGHEST_CHARGE = 100.0;

/// Progress of an action. Running and paused alternate, so they are equal.
int GetProgress(VDA5050::EActionStatus status)
{
    switch (status)
    {
        case VDA5050::EActionStatus::Waiting:
            return 0;
        case VDA5050::EActionStatus::Initializing:
            return 1;
        case VDA5050::EActionStatus::Running:
        case VDA5050::EActionStatus::Paused:
            return 2;
        case VDA5050::EActionStatus::Finished:
        case VDA5050::EActionStatus::Failed:
        default:
            return 3;
    }
}

/// States get lost, so an action may skip some. It never goes back and does not leave a terminal status.
bool IsBackwards(VDA5050::EActionStatus before, VDA5050::EActionStatus after)
{
    return GetProgress(after) < GetProgress(before) || (VDA5050::IsTerminal(before) && after != before);
}

/// "2.1" of "2.1.0"
std::string_view GetMajorMinor(std::string_view version)
{
    const std::size_t dot = version.find('.');
    return dot == std::string_view::npos ? version : version.substr(0, version.find('.', dot + 1));
}

} // namespace

VehicleWatch::VehicleWatch(
    const Planning::SiteMap& site,
    std::string robotID,
    const Dependencies& dependencies,
    LoadPositions positions,
    std::string protocolVersion)
    : _site(site),
      _robotID(std::move(robotID)),
      _clock(dependencies.clock),
      _log(dependencies.logger),
      _metrics(dependencies.metrics),
      _positions(std::move(positions)),
      _protocolVersion(std::move(protocolVersion)),
      _rangeX(FindRange(site, &Planning::SiteNode::x)),
      _rangeY(FindRange(site, &Planning::SiteNode::y))
{
    _metrics.AddCounter(ODDITIES, "Contradictions in what robots report, by kind");
}

VehicleWatch::Range VehicleWatch::FindRange(const Planning::SiteMap& site, double Planning::SiteNode::*coordinate)
{
    const auto [low, high] = std::ranges::minmax_element(site.GetNodes(), {}, coordinate);
    return {(*low).*coordinate - MARGIN, (*high).*coordinate + MARGIN};
}

void VehicleWatch::Note(std::string_view kind, std::string_view detail)
{
    const std::string name(kind);
    const std::uint64_t total = ++_counts[name];
    _metrics.Increment(ODDITIES, {{"kind", name}});
    _log.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Warning,
        kind,
        "the robot reports a contradiction",
        {{"robotId", _robotID},
         {"what", kind},
         {"detail", Core::ShortenText(detail)},
         {"count", std::to_string(total)}});
}

void VehicleWatch::OnState(const VDA5050::StateMessage& state)
{
    CheckPosition(state);
    CheckLoads(state);
    if (_shown.has_value())
    {
        CheckOrder(state);
        CheckActions(state);
    }
    Shown shown{state.orderID, state.orderUpdateID, state.lastNodeSequenceID, {}};
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        if (!shown.actions.emplace(action.actionID, action.actionStatus).second)
        {
            Note("action_twice", action.actionID);
        }
    }
    _shown = std::move(shown);
}

void VehicleWatch::OnFactsheet(const VDA5050::FactsheetMessage& factsheet)
{
    for (const std::string& contradiction : VDA5050::FindContradictions(factsheet))
    {
        Note("factsheet", contradiction);
    }
}

void VehicleWatch::OnAway()
{
    _shown.reset();
}

void VehicleWatch::CheckPosition(const VDA5050::StateMessage& state)
{
    if (!state.lastNodeID.empty() && _site.FindNodeOrNull(state.lastNodeID) == nullptr)
    {
        Note("unknown_node", state.lastNodeID);
    }
    if (state.agvPosition.has_value() && state.agvPosition->bPositionInitialized)
    {
        const VDA5050::AgvPosition& at = *state.agvPosition;
        if (at.x < _rangeX.low || at.x > _rangeX.high || at.y < _rangeY.low || at.y > _rangeY.high)
        {
            Note("off_map", fmt::format("x {} y {}", at.x, at.y));
        }
    }
    CheckDistance(state);
    const double charge = state.batteryState.batteryCharge;
    if (charge < 0 || charge > HIGHEST_CHARGE)
    {
        Note("battery_range", fmt::format("{} %", charge));
    }
}

/// A vehicle that is driven by hand may be anywhere.
void VehicleWatch::CheckDistance(const VDA5050::StateMessage& state)
{
    const Planning::SiteNode* const nodeOrNull = _site.FindNodeOrNull(state.lastNodeID);
    if (nodeOrNull == nullptr || !state.agvPosition.has_value() || !state.agvPosition->bPositionInitialized
        || !VDA5050::IsLedByMaster(state.operatingMode))
    {
        return;
    }
    const double distance = std::hypot(state.agvPosition->x - nodeOrNull->x, state.agvPosition->y - nodeOrNull->y);
    const auto leadsThere = [this, nodeOrNull, distance](const Planning::SiteEdge& edge) {
        return edge.startNodeID == nodeOrNull->nodeID
            && distance <= Planning::GetDistance(*nodeOrNull, *_site.FindNodeOrNull(edge.endNodeID)) + MARGIN;
    };
    if (distance > MARGIN && std::ranges::none_of(_site.GetEdges(), leadsThere))
    {
        Note("far_from_node", fmt::format("{:.1f} m from {}", distance, nodeOrNull->nodeID));
    }
}

/// For a robot whose ports the vehicle reports. With a load at an unknown position, acsd does not know the load of any port.
void VehicleWatch::CheckLoads(const VDA5050::StateMessage& state)
{
    if (!state.loads.has_value() || _positions.IsEmpty())
    {
        return;
    }
    for (const VDA5050::Load& load : *state.loads)
    {
        if (_positions.FindPortOrNull(load.loadPosition) == nullptr)
        {
            Note("unknown_load_position", fmt::format("\"{}\": add it to load_positions", load.loadPosition));
        }
    }
}

void VehicleWatch::CheckOrder(const VDA5050::StateMessage& state)
{
    if (state.orderID.empty() || state.orderID != _shown->orderID)
    {
        return;
    }
    if (state.orderUpdateID < _shown->orderUpdateID)
    {
        Note(
            "update_backwards",
            fmt::format("order {}: {} after {}", state.orderID, state.orderUpdateID, _shown->orderUpdateID));
    }
    if (state.lastNodeSequenceID < _shown->lastNodeSequenceID)
    {
        Note(
            "node_backwards",
            fmt::format("order {}: {} after {}", state.orderID, state.lastNodeSequenceID, _shown->lastNodeSequenceID));
    }
}

void VehicleWatch::CheckActions(const VDA5050::StateMessage& state)
{
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        const auto before = _shown->actions.find(action.actionID);
        if (before != _shown->actions.end() && IsBackwards(before->second, action.actionStatus))
        {
            Note(
                "action_backwards",
                fmt::format(
                    "{}: {} after {}",
                    action.actionID,
                    VDA5050::GetStatusText(action.actionStatus),
                    VDA5050::GetStatusText(before->second)));
        }
    }
}

void VehicleWatch::OnStatistics(const VDA5050::MasterStatistics& statistics)
{
    const auto count =
        [this](std::uint64_t before, std::uint64_t after, std::string_view kind, std::string_view detail) {
            for (std::uint64_t i = before; i < after; ++i)
            {
                Note(kind, detail);
            }
        };
    count(_statistics.messagesRefused, statistics.messagesRefused, "unreadable_message", statistics.lastRefusal);
    count(_statistics.statesIgnored, statistics.statesIgnored, "state_out_of_order", "older than the one before");
    count(_statistics.retainedIgnored, statistics.retainedIgnored, "state_retained", "retained, of unknown age");
    if (statistics.lastVersion != _statistics.lastVersion)
    {
        CheckVersion(statistics.lastVersion);
    }
    _statistics = statistics;
}

std::string VehicleWatch::DescribeVersion(const std::string& version) const
{
    return fmt::format(
        "its messages have the VDA5050 version {}, robots.{}.protocol is {}: correct one of them",
        version,
        _robotID,
        _protocolVersion);
}

void VehicleWatch::CheckVersion(const std::string& version)
{
    constexpr std::size_t MOST_VERSIONS = 8;
    if (GetMajorMinor(version) == GetMajorMinor(_protocolVersion) || _otherVersions.size() == MOST_VERSIONS
        || std::ranges::count(_otherVersions, version) > 0)
    {
        return;
    }
    _otherVersions.push_back(version);
    Note("version", DescribeVersion(version));
}

std::vector<std::string> VehicleWatch::ListWarnings() const
{
    std::vector<std::string> warnings;
    for (const std::string& version : _otherVersions)
    {
        warnings.push_back(DescribeVersion(version));
    }
    return warnings;
}

void VehicleWatch::OnArmEvent(const OpenStream::ClientEvent& event)
{
    std::visit(
        Core::Overloaded{
            [&](const OpenStream::ClientBadLine& bad) { Note("arm_bad_line", bad.detail); },
            [&](const OpenStream::ClientErrorReported& reported) {
                Note("arm_error_line", reported.error.codeText + " " + reported.error.message);
            },
            [&](const OpenStream::ClientMonitorRefused& refused) {
                Note("arm_monitor_refused", refused.error.codeText + " " + refused.error.message);
            },
            [&](const OpenStream::ClientControlFault& fault) { Note("arm_control_fault", fault.detail); },
            [&](const OpenStream::ClientMonitorStale& stale) {
                Note("arm_silent", fmt::format("no sample for {} ms", stale.age.count()));
            },
            [](const auto&) { /* as it should be */ }},
        event);
}

} // namespace ACS::Acsd
