#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "robots/LoadPositions.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Checks what one robot reports for contradictions; logs them, rate-limited, and counts them by kind. Decides nothing:
/// sessions and engine tolerate them by themselves. Pure.
class VehicleWatch final
{
public:
    /// Everything outlives the watch.
    struct Dependencies
    {
        const Core::IClock& clock;
        Core::Logger logger;
        Apps::MetricsEndpoint& metrics;
    };

    /// How far outside the rectangle around all nodes a vehicle may be, in metres.
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
    Apps::MetricsEndpoint& _metrics;
    std::map<std::string, std::uint64_t, std::less<>> _counts; ///< By kind. Kinds are constants of the code.
    LoadPositions _positions;
    std::optional<Shown> _shown;
    VDA5050::MasterStatistics _statistics; ///< As they were at the last look.
    Range _rangeX;                         ///< Both: around the site's nodes.
    Range _rangeY;

public:
    /// The site outlives the watch.
    VehicleWatch(
        const Planning::SiteMap& site,
        std::string robotID,
        const Dependencies& dependencies,
        LoadPositions positions);

    /// A state that the session took as new.
    void OnState(const VDA5050::StateMessage& state);

    /// The vehicle's numbers may begin anew (it was away).
    void OnAway();

    /// What the session threw away since the last look.
    void OnStatistics(const VDA5050::MasterStatistics& statistics);

    void OnArmEvent(const OpenStream::ClientEvent& event);

private:
    [[nodiscard]] static Range FindRange(const Planning::SiteMap& site, double Planning::SiteNode::*coordinate);
    void LookAtPlace(const VDA5050::StateMessage& state);
    void CheckLoads(const VDA5050::StateMessage& state);
    void LookAtOrder(const VDA5050::StateMessage& state);
    void LookAtActions(const VDA5050::StateMessage& state);
    void Note(std::string_view kind, std::string_view detail);
};

} // namespace ACS::Acsd
