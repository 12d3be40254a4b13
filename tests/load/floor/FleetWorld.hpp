#pragma once

#include "Floor.hpp"
#include "FloorVehicle.hpp"
#include "IFleetControl.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include "TransportLog.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// The vehicles, their work and their faults.
struct FleetOptions
{
    std::uint64_t seed = 1;
    std::size_t vehicles = 20;
    std::size_t transports = 1'000;
    std::size_t plansAtOnce = 40; ///< Plans that are submitted and not finished.
    std::uint64_t priorities = 3;
    bool bFaults = false; ///< Vehicles pause, are slow, are lost, and recover.
};

/// A fleet in virtual time. Vehicles drive along what is released to them; their positions are independent of the data of what
/// controls them.
class FleetWorld
{
    enum class EHappening : std::uint8_t
    {
        Engine,
        Accept,
        Leg,
        Job,
        Fault,
        Recovery,
    };

    struct Entry
    {
        Core::SteadyTime time;
        std::uint64_t order = 0;
        EHappening happening = EHappening::Engine;
        std::size_t vehicle = 0;
        Planning::EngineTimer timer;
        std::uint64_t generation = 0;

        bool operator>(const Entry& other) const noexcept
        {
            return time != other.time ? time > other.time : order > other.order;
        }
    };

    FleetOptions _options;
    ManualClock _clock;
    SeededRandom _random;
    const Floor& _floor;
    const Planning::SiteMap& _site;
    TransportLog _transports;
    std::unique_ptr<IFleetControl> _control;
    std::vector<FloorVehicle> _vehicles;
    std::map<std::string, std::size_t> _indices;
    std::map<std::string, std::uint64_t> _onNode;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> _entries;
    std::map<Planning::EngineTimer, std::uint64_t> _timers;
    std::deque<std::pair<std::size_t, Planning::RobotEvent>> _raised;
    std::uint64_t _order = 0;
    std::uint64_t _submitted = 0; ///< Number of plans.

public:
    std::vector<std::string> violations;
    std::size_t events = 0; ///< Events that were raised.
    std::size_t drives = 0;
    std::size_t cancels = 0; ///< Drives that were cancelled for a reroute or to yield.

    /// The floor must outlive the world.
    FleetWorld(const Floor& floor, const FleetOptions& options, std::unique_ptr<IFleetControl> control);

    /// Runs until all transports are done. False: they are not, and no event is left or a week has passed.
    [[nodiscard]] bool TryRun();

    [[nodiscard]] const TransportLog& GetTransports() const noexcept;
    [[nodiscard]] double GetVirtualHours() const;
    /// The position and the drive of each vehicle, for a run that does not end.
    [[nodiscard]] std::string Describe() const;

private:
    [[nodiscard]] std::uint64_t GetRandom(std::uint64_t below);
    void Push(EHappening happening, std::size_t vehicle, std::uint64_t generation, Core::Duration delay);
    void SubmitMore();
    void Execute(const Planning::EngineActions& actions);
    void OnReport(const Planning::Report& report);
    void Obey(FloorVehicle& vehicle, const Planning::RobotCommand& command);
    void RaiseEvent(FloorVehicle& vehicle, Planning::RobotEvent event);
    void PublishState(FloorVehicle& vehicle);
    void DeliverEvents();
    void Happen(const Entry& entry);
    void BeginLeg(FloorVehicle& vehicle);
    void EndLeg(FloorVehicle& vehicle);
    void Continue(FloorVehicle& vehicle);
    void Stop(FloorVehicle& vehicle);
    void ChangeSpeed(FloorVehicle& vehicle, double speed, bool bPaused);
    void Fault();
    void Recover(FloorVehicle& vehicle);
    void CheckPlaces();
};

} // namespace ACS::Testing
