#pragma once

#include "ManualClock.hpp"
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/VehicleAction.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::VDA5050::Test
{

[[nodiscard]] VehicleAddress MakeAddress();
[[nodiscard]] Action MakeAction(std::string actionID, EBlockingType blockingType, std::string actionType = "pick");

/// N0 at the origin, N1 at x = 10, N2 at x = 20, …; edges E0, E1, …
[[nodiscard]] std::vector<OrderNode> MakeNodes(std::size_t count);
[[nodiscard]] std::vector<OrderEdge> MakeEdges(std::size_t count);
[[nodiscard]] OrderBuilder MakeBuilder(std::size_t nodeCount, std::string orderID = "order-1");
/// All nodes, the first releasedNodes of them as base.
[[nodiscard]] OrderMessage MakeOrder(std::size_t nodeCount, std::size_t releasedNodes, std::string orderID = "order-1");

/// The actions of one kind, in order.
template <typename TWanted, typename TAction>
[[nodiscard]] std::vector<TWanted> Pick(const std::vector<TAction>& actions)
{
    std::vector<TWanted> picked;
    for (const TAction& action : actions)
    {
        if (const auto* wanted = std::get_if<TWanted>(&action))
        {
            picked.push_back(*wanted);
        }
    }
    return picked;
}

/// A vehicle at N0 that is linked; it writes down what it is told, and drives nowhere by itself.
class VehicleBench
{
    Testing::ManualClock _clock;
    VehicleSession _session;
    VehicleActions _out;
    std::uint32_t _headerID = 0;

public:
    explicit VehicleBench(VehicleOptions options = MakeOptions());

    [[nodiscard]] static VehicleOptions MakeOptions();

    [[nodiscard]] VehicleSession& GetSession();
    [[nodiscard]] Core::Now GetNow() const;
    [[nodiscard]] const VehicleActions& GetOutput() const;
    void Clear();
    void Advance(std::chrono::milliseconds span);

    void Order(OrderMessage order);
    void Payload(ETopic topic, std::string_view payload, bool bRetained = false);
    void Instant(std::string_view actionType, const std::string& actionID);
    void Reach(std::uint32_t sequenceID);
    void Drive(bool bDriving);
    void Status(std::string_view actionID, EActionStatus status);
    void StandAt(double x);

    /// The last state that was published, or the present one where none was.
    [[nodiscard]] StateMessage GetPublishedState() const;
    [[nodiscard]] std::vector<StateMessage> GetPublishedStates() const;
    [[nodiscard]] std::vector<std::string> GetStartedActions() const;
    [[nodiscard]] EActionStatus GetStatus(std::string_view actionID) const;
    [[nodiscard]] bool HasError(std::string_view errorType) const;
};

[[nodiscard]] std::vector<std::string> ListNodes(const StateMessage& state);

} // namespace ACS::VDA5050::Test
