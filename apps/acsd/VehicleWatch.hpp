#pragma once

#include "LoadPositions.hpp"
#include "OddityLog.hpp"
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

/// Looks at what one robot says for what cannot be, beside the sessions and the engine, which survive it anyway: nothing is
/// decided here. Pure.
class VehicleWatch final
{
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
    OddityLog& _oddities;
    LoadPositions _positions;
    std::optional<Shown> _shown;
    VDA5050::MasterStatistics _statistics; ///< As they were at the last look.
    Range _rangeX;                         ///< Both: around the site's nodes.
    Range _rangeY;

    [[nodiscard]] static Range FindRange(const Planning::SiteMap& site, double Planning::SiteNode::*coordinate);
    void LookAtPlace(const VDA5050::StateMessage& state);
    void CheckLoads(const VDA5050::StateMessage& state);
    void LookAtOrder(const VDA5050::StateMessage& state);
    void LookAtActions(const VDA5050::StateMessage& state);
    void Note(std::string_view kind, std::string_view detail);

public:
    /// How far outside the rectangle around all nodes a vehicle may be, in metres.
    static constexpr double MARGIN = 5.0;

    /// Site and log outlive it.
    VehicleWatch(const Planning::SiteMap& site, std::string robotID, OddityLog& oddities, LoadPositions positions);

    /// A state that the session took as new.
    void OnState(const VDA5050::StateMessage& state);

    /// The vehicle's numbers may begin anew (it was away).
    void OnAway();

    /// What the session threw away since the last look.
    void OnStatistics(const VDA5050::MasterStatistics& statistics);

    void OnArmEvent(const OpenStream::ClientEvent& event);
};

} // namespace ACS::Acsd
