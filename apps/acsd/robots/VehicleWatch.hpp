#pragma once

#include "common/log/LogRateLimiter.hpp"
#include "robots/LoadPositions.hpp"
#include <acs/acsd/IRobotMetrics.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Checks the reports of one robot for contradictions; logs them, rate-limited, and counts them by kind. Has no other effect:
/// sessions and engine tolerate contradictions. Pure.
class VehicleWatch final
{
public:
    /// All of these must outlive the watch.
    struct Dependencies
    {
        const Core::IClock& clock;
        Core::Logger logger;
        IRobotMetrics& metrics;
    };

    /// How far outside the rectangle around all nodes, or beyond the lanes of its last node, a vehicle may be, in metres.
    static constexpr double MARGIN = 5.0;

private:
    struct Shown
    {
        std::string orderID;
        std::uint32_t orderUpdateID = 0;
        std::uint32_t lastNodeSequenceID = 0;
        std::map<std::string, VDA5050::EActionStatus> actions;
    };

    /// Metres.
    struct Range
    {
        double low = 0;
        double high = 0;
    };

    const Planning::SiteMap& _site;
    std::string _robotID;
    const Core::IClock& _clock;
    Apps::LogRateLimiter _log;
    IRobotMetrics& _metrics;
    std::map<std::string, std::uint64_t, std::less<>> _counts; ///< By kind; the number of kinds is fixed.
    LoadPositions _positions;
    std::string _protocolVersion;
    std::vector<std::string> _otherVersions; ///< As reported.
    std::optional<Shown> _shown;
    VDA5050::MasterStatistics _statistics; ///< At the last check.
    Range _rangeX;                         ///< Range of the site's nodes.
    Range _rangeY;

public:
    /// The site must outlive the watch.
    VehicleWatch(
        const Planning::SiteMap& site,
        std::string robotID,
        const Dependencies& dependencies,
        LoadPositions positions,
        std::string protocolVersion);

    /// A state that the session accepted as new.
    void OnState(const VDA5050::StateMessage& state);

    void OnFactsheet(const VDA5050::FactsheetMessage& factsheet);

    /// The vehicle was disconnected: its sequence numbers may begin again.
    void OnAway();

    /// Counts the messages that the session dropped since the last check, and notes a version of the protocol that the robot is not
    /// configured for, once for each version.
    void OnStatistics(const VDA5050::MasterStatistics& statistics);

    void OnArmEvent(const OpenStream::ClientEvent& event);

    /// Lasting contradictions, for the status page.
    [[nodiscard]] std::vector<std::string> ListWarnings() const;

private:
    [[nodiscard]] static Range FindRange(const Planning::SiteMap& site, double Planning::SiteNode::*coordinate);
    [[nodiscard]] std::string DescribeVersion(const std::string& version) const;
    void CheckVersion(const std::string& version);
    void CheckPosition(const VDA5050::StateMessage& state);
    void CheckDistance(const VDA5050::StateMessage& state);
    void CheckLoads(const VDA5050::StateMessage& state);
    void CheckOrder(const VDA5050::StateMessage& state);
    void CheckActions(const VDA5050::StateMessage& state);
    void Note(std::string_view kind, std::string_view detail);
};

} // namespace ACS::Acsd
