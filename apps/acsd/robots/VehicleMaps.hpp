#pragma once

#include "robots/VehicleMap.hpp"
#include <acs/plan/RobotEvent.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace ACS::Acsd
{

/// A map of the site that a vehicle must have enabled before it drives.
struct NeededMap
{
    std::string mapID;
    std::string version;      ///< Empty: any version, which acsd does not enable.
    std::string downloadLink; ///< Empty: acsd does not download the map. Else with a version.
    std::string hash;         ///< Of the download; may be empty.

    bool operator==(const NeededMap&) const = default;
};

/// Compares the maps that a vehicle reports with those it needs, and has the vehicle download and enable the missing ones. A
/// vehicle that reports no maps has no error.
class VehicleMaps final
{
    /// What a vehicle is asked to do with a map.
    struct Task
    {
        std::string mapID;
        bool bDownload; ///< Otherwise enable.

        bool operator<(const Task& other) const noexcept
        {
            return std::tie(mapID, bDownload) < std::tie(other.mapID, other.bDownload);
        }
    };

    struct Request
    {
        std::string actionID;
        Task task;
    };

    static constexpr std::size_t MOST_REQUESTS =
        3; ///< Of a task that the vehicle reports as finished, without the effect.

    std::vector<NeededMap> _needed;
    std::optional<std::vector<VDA5050::MapState>> _reported;
    std::optional<Request> _request;            ///< The vehicle executes one at a time.
    std::map<Task, std::string> _failures;      ///< Since the vehicle was connected.
    std::map<Task, std::size_t> _requestCounts; ///< Since the vehicle was connected.

public:
    explicit VehicleMaps(std::vector<NeededMap> needed);
    /// The vehicle needs the maps of its nodes; configured: how it gets them.
    VehicleMaps(const VehicleMap& map, const std::vector<NeededMap>& configured);

    /// The vehicle was connected: what has failed is tried again.
    void OnConnected();
    void OnReported(std::optional<std::vector<VDA5050::MapState>> mapsOrNull);
    /// The instant action that brings the next missing map, without an id; nullopt: nothing to do, or one is being executed.
    [[nodiscard]] std::optional<VDA5050::Action> MakeRequestOrNull() const;
    /// The action of MakeRequestOrNull was sent with this id.
    void OnSent(std::string actionID);
    /// The action of MakeRequestOrNull cannot be sent.
    void OnNotSent(const std::string& error);
    /// The action has ended. error: why it failed; empty: done. False: it is not that of the current request.
    bool TryEnd(const std::string& actionID, const std::string& error);
    /// Likewise, if the action has ended.
    bool TryApply(const VDA5050::ActionChanged& action);
    /// One for each map that is not enabled: the vehicle must not drive.
    [[nodiscard]] std::vector<Planning::RobotError> ListErrors() const;

private:
    /// Null: the vehicle does not have the map.
    [[nodiscard]] const VDA5050::MapState* FindReportedOrNull(const NeededMap& map) const;
    [[nodiscard]] bool IsEnabled(const NeededMap& map) const;
    [[nodiscard]] const NeededMap* FindNextOrNull() const;
    [[nodiscard]] Task MakeTask(const NeededMap& map) const;
};

} // namespace ACS::Acsd
