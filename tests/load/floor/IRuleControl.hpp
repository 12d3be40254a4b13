#pragma once

#include "Floor.hpp"
#include "IFleetControl.hpp"
#include <acs/plan/Router.hpp>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// Controls vehicles by a simple rule, to compare the engine with it: plans in their order, each to the nearest free vehicle, which
/// takes the quickest route. A vehicle without a plan drives to its parking position. What a vehicle may drive onto is up to the
/// derived class.
class IRuleControl : public IFleetControl
{
protected:
    struct Vehicle
    {
        std::string robotID;
        std::size_t node = 0;
        std::size_t home = 0;
        std::optional<Planning::Plan> plan;
        std::size_t step = 0;
        std::optional<Planning::Drive> drive;
        std::vector<std::size_t> route; ///< Of the drive, by index in the map.
        std::size_t granted = 0;        ///< Nodes of it, from the start.
        std::size_t passed = 0;         ///< Index of the last one passed.
        bool bWorks = false;
    };

private:
    const Planning::SiteMap& _site;
    Planning::Router _router;
    std::vector<Vehicle> _vehicles;
    std::deque<Planning::Plan> _queue;
    std::map<std::string, std::string> _robotIDs; ///< By plan.
    std::uint64_t _driveCount = 0;

public:
    IRuleControl(const Floor& floor, std::size_t vehicles);

    void Submit(Planning::Plan plan, std::uint64_t number, Core::Now now, Planning::EngineActions& out) override;
    void OnEvent(
        const std::string& robotID,
        const Planning::RobotEvent& event,
        Core::Now now,
        Planning::EngineActions& out) override;
    void OnTimer(const Planning::EngineTimer& timer, Core::Now now, Planning::EngineActions& out) override;
    void OnStored(Core::Now now, Planning::EngineActions& out) override;
    void OnReportSent(std::uint64_t sequence, Core::Now now, Planning::EngineActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRobotIDOrNull(const std::string& planID) const override;

protected:
    [[nodiscard]] const Planning::SiteMap& GetSite() const noexcept;
    [[nodiscard]] std::size_t CountVehicles() const noexcept;
    [[nodiscard]] std::size_t GetIndex(const Vehicle& vehicle) const;
    [[nodiscard]] const Vehicle& GetVehicle(std::size_t index) const;
    [[nodiscard]] std::size_t GetDock(const std::string& stationID) const;
    /// The nodes of the quickest route, by index in the map.
    [[nodiscard]] std::vector<std::size_t> FindRoute(std::size_t from, std::size_t to) const;
    /// Whether the vehicle may begin this plan now; it does so if it may.
    [[nodiscard]] virtual bool TryTakePlan(const Vehicle& vehicle, const Planning::Plan& plan) = 0;
    /// The number of nodes of the route, from the start, onto which it may drive now.
    [[nodiscard]] virtual std::size_t Grant(const Vehicle& vehicle) = 0;
    /// It is on another node of its route, or has ended its drive there.
    virtual void OnPassed(const Vehicle& vehicle) = 0;

private:
    void Run(Planning::EngineActions& out);
    void Assign(Planning::EngineActions& out);
    [[nodiscard]] Vehicle* FindNearestOrNull(const Planning::Plan& plan);
    void Move(Vehicle& vehicle, Planning::EngineActions& out);
    void BeginDrive(Vehicle& vehicle, std::size_t target, Planning::EngineActions& out);
    void Extend(Vehicle& vehicle, Planning::EngineActions& out);
    static void EndJob(Vehicle& vehicle, Planning::EngineActions& out);
    static void Report(const Vehicle& vehicle, Planning::EPlanState state, Planning::EngineActions& out);
};

} // namespace ACS::Testing
