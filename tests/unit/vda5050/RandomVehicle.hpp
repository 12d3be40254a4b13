#pragma once

#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include "StateSequenceChecker.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050::Test
{

/// A VehicleSession in virtual time with a vehicle and a master that act at random. The vehicle obeys the session. Its states
/// are checked.
class RandomVehicle
{
public:
    static constexpr std::chrono::milliseconds MINIMUM{50};

private:
    using Event = std::function<void()>;

    Testing::ManualClock _clock;
    Testing::SeededRandom _random;
    VehicleSession _session;
    Vda5050Codec _codec;
    VehicleActions _out;
    Testing::StateSequenceChecker _checker{MINIMUM};
    std::multimap<Core::SteadyTime, Event> _events; ///< Of the vehicle.
    std::map<EVehicleTimer, Core::SteadyTime> _timers;
    std::map<std::string, StartAction> _running;
    std::optional<DriveTo> _leg;
    std::optional<OrderBuilder> _order;
    std::uint64_t _drive = 0; ///< Changes when the present drive ends.
    std::uint32_t _headerID = 0;
    std::uint32_t _nextID = 0;

public:
    explicit RandomVehicle(std::uint64_t seed);

    /// The next event of the vehicle, or an action of the master.
    void Step();
    /// The master sends stopPause and no more orders; the vehicle ends its order.
    void Finish();
    [[nodiscard]] const Testing::StateSequenceChecker& GetChecker() const;

private:
    [[nodiscard]] static VehicleOptions MakeOptions(bool bStopsBetweenNodes);
    [[nodiscard]] std::uint32_t Choose(std::uint32_t count);
    [[nodiscard]] std::string MakeID(std::string_view prefix);
    void After(std::uint32_t maximumMilliseconds, Event event);
    /// False if nothing is left but the maximum interval.
    [[nodiscard]] bool TryPassTime(bool bSkip);
    void Execute();
    void Check(const MqttMessage& message);
    void Perform(const DriveTo& drive);
    void Arrive();
    void Stop();
    void Perform(const StartAction& start);
    void Perform(const StopAction& stop);
    void SetStatus(const std::string& actionID, EActionStatus status);
    void ActAsMaster();
    void SendOrder();
    void Send(OrderMessage order);
    void SendInstantAction(std::string_view actionType);
    void AddActions(std::vector<Action>& actions, std::string_view prefix);
};

} // namespace ACS::VDA5050::Test
