#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace ACS::Planning
{

namespace
{

class ErrorFinder
{
    /// A home or charging station.
    struct ParkingStation
    {
        std::string robotID;
        std::string stationID;
        std::string path; ///< Of its option.
    };

    const SiteMap& _site;
    std::vector<Core::Error> _mistakes;
    std::set<std::string> _robotIDs;
    std::map<std::string, ParkingStation> _parking; ///< By node.
    std::set<std::string> _starts;

public:
    explicit ErrorFinder(const SiteMap& site)
        : _site(site)
    {
    }

    void Add(std::string path, std::string expected, std::string found)
    {
        _mistakes.push_back(
            {make_error_code(EPlanningError::InvalidOptions), std::move(path), std::move(expected), std::move(found)});
    }

    void Check(const RobotOptions& robot)
    {
        const std::string path = "robots." + robot.robotID.GetText();
        if (robot.robotID.IsAlias() || !_robotIDs.insert(robot.robotID.GetText()).second)
        {
            Add(path, "a unique robot name", robot.robotID.GetText());
        }
        const bool bTypeKnown = _site.HasVehicleType(robot.vehicleTypeID);
        if (!bTypeKnown)
        {
            Add(path + ".vehicle_type", "a vehicle type of the site map", robot.vehicleTypeID);
        }
        if (robot.startNodeID.has_value())
        {
            CheckStart(path + ".start_node", robot, bTypeKnown);
        }
        if (robot.homeStationID.has_value())
        {
            CheckStation(path + ".home", *robot.homeStationID, robot, bTypeKnown);
        }
        if (robot.chargingStationID.has_value())
        {
            CheckStation(path + ".charge", *robot.chargingStationID, robot, bTypeKnown);
        }
        CheckPorts(path + ".ports", robot, robot.ports);
        CheckPorts(path + ".child_ports", robot, robot.childPorts);
    }

    void CheckPlaces(const std::vector<Core::Location>& places)
    {
        std::set<std::string> strangers;
        for (const Core::Location& place : places)
        {
            std::string station = place.GetDockingPlace().GetText();
            if (_site.FindStationOrNull(station) == nullptr && strangers.insert(std::move(station)).second)
            {
                Add("site.ports", "ports at stations of the site map", place.GetText());
            }
        }
    }

    void CheckReach(const std::string& stationID, const std::vector<std::string>& reached)
    {
        const std::string path = fmt::format("stations.\"{}\".reach", stationID);
        if (_site.FindStationOrNull(stationID) == nullptr)
        {
            Add(path, "a station of the site map", stationID);
        }
        for (const std::string& other : reached)
        {
            if (_site.FindStationOrNull(other) == nullptr)
            {
                Add(path, "stations of the site map", other);
            }
        }
    }

    /// Robots of two parking stations within the clearance of each other could never both be there.
    void CheckParkingDistances(double clearance)
    {
        for (auto left = _parking.begin(); left != _parking.end(); ++left)
        {
            for (auto right = std::next(left); right != _parking.end(); ++right)
            {
                const SiteNode& leftNode = *_site.FindNodeOrNull(left->first);
                const SiteNode& rightNode = *_site.FindNodeOrNull(right->first);
                const double distance = GetDistance(leftNode, rightNode);
                if (left->second.robotID != right->second.robotID && leftNode.mapID == rightNode.mapID
                    && distance <= clearance)
                {
                    Add(right->second.path,
                        fmt::format(
                            "a station farther than traffic.clearance ({:.2f} m) from {}, the home or charging station of {}",
                            clearance,
                            left->second.stationID,
                            left->second.robotID),
                        fmt::format("{}, {:.2f} m from it", right->second.stationID, distance));
                }
            }
        }
    }

    [[nodiscard]] std::vector<Core::Error> TakeErrorTexts()
    {
        return std::move(_mistakes);
    }

private:
    [[nodiscard]] bool CanUse(const std::string& nodeID, const RobotOptions& robot) const
    {
        const SiteNode* nodeOrNull = _site.FindNodeOrNull(nodeID);
        return nodeOrNull != nullptr && nodeOrNull->FindRuleOrNull(robot.vehicleTypeID) != nullptr;
    }

    void CheckStart(std::string path, const RobotOptions& robot, bool bTypeKnown)
    {
        if (bTypeKnown && !CanUse(*robot.startNodeID, robot))
        {
            Add(std::move(path), "a node of the site map that its vehicle type may use", *robot.startNodeID);
        }
        else if (!_starts.insert(*robot.startNodeID).second)
        {
            Add(std::move(path), "a node where no other robot starts", *robot.startNodeID);
        }
    }

    /// Home and charging stations are exclusive.
    void CheckStation(std::string path, const std::string& stationID, const RobotOptions& robot, bool bTypeKnown)
    {
        const SiteStation* stationOrNull = _site.FindStationOrNull(stationID);
        if (stationOrNull == nullptr)
        {
            Add(std::move(path), "a station of the site map", stationID);
        }
        else if (bTypeKnown && !CanUse(stationOrNull->nodeIDs.front(), robot))
        {
            Add(std::move(path), "a station whose node its vehicle type may use", stationID);
        }
        else if (
            _parking
                .try_emplace(stationOrNull->nodeIDs.front(), ParkingStation{robot.robotID.GetText(), stationID, path})
                .first->second.robotID
            != robot.robotID.GetText())
        {
            Add(std::move(path), "a station that is not the home or charging station of another robot", stationID);
        }
    }

    void CheckPorts(const std::string& path, const RobotOptions& robot, const std::vector<Core::Location>& ports)
    {
        std::set<std::string> known;
        for (const Core::Location& port : ports)
        {
            if (!port.IsRobotPort() || port.GetRobotOrNull() != robot.robotID || !known.insert(port.GetText()).second)
            {
                Add(path, "ports of this robot, each once", port.GetText());
            }
        }
    }
};

ActionRule MakeRule(ERobotType type, EPlaceRule from, EPlaceRule to, EActionEffect effect)
{
    ActionRule rule;
    rule.robotType = type;
    rule.from = from;
    rule.to = to;
    rule.effect = effect;
    rule.bJobsRequired = from != EPlaceRule::None;
    return rule;
}

} // namespace

ActionTable MakeStandardActions()
{
    using enum EPlaceRule;
    const ActionRule plain = MakeRule(ERobotType::CR, None, None, EActionEffect::None);
    return {
        {"CassetteLoad", MakeRule(ERobotType::LR, FixedCassette, RobotCassette, EActionEffect::Load)},
        {"CassetteUnload", MakeRule(ERobotType::LR, RobotCassette, FixedCassette, EActionEffect::Unload)},
        {"TrayLoad", MakeRule(ERobotType::CR, FixedTray, RobotTray, EActionEffect::Load)},
        {"TrayUnload", MakeRule(ERobotType::CR, RobotTray, FixedTray, EActionEffect::Unload)},
        {"MemoryPickAndPlace", MakeRule(ERobotType::CR, Memory, Memory, EActionEffect::None)},
        {"OpenSetCover", plain},
        {"CloseSetCover", plain},
        {"Start", plain},
    };
}

std::vector<Core::Error> FindErrors(const EngineOptions& options, const SiteMap& site)
{
    ErrorFinder finder(site);
    for (const RobotOptions& robot : options.robots)
    {
        finder.Check(robot);
    }
    finder.CheckParkingDistances(options.clearance);
    finder.CheckPlaces(options.places);
    for (const auto& [stationID, reached] : options.reach)
    {
        finder.CheckReach(stationID, reached);
    }
    if (options.baseLength == 0)
    {
        finder.Add("traffic.base_length", "at least 1", "0");
    }
    if (!(options.clearance >= 0))
    {
        finder.Add("traffic.clearance", "a distance in metres, 0 or more", fmt::format("{}", options.clearance));
    }
    if (options.maximumPlans == 0)
    {
        finder.Add("queue.max_plans", "at least 1", "0");
    }
    if (options.maximumRejections == 0)
    {
        finder.Add("robot.max_rejections", "at least 1", "0");
    }
    const DispatchOptions& dispatch = options.dispatch;
    if (!(dispatch.batteryFloor >= 0 && dispatch.batteryFloor < dispatch.batteryResume
          && dispatch.batteryResume <= 100))
    {
        finder.Add(
            "robot.battery_floor",
            "0 to 100 percent, and less than robot.battery_resume",
            fmt::format("{} and {}", dispatch.batteryFloor, dispatch.batteryResume));
    }
    return finder.TakeErrorTexts();
}

} // namespace ACS::Planning
