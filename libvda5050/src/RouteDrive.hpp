#pragma once

#include "RemainingRoute.hpp"
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VehicleAction.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// The remaining route of a vehicle, its place on it, and the drive to the next node: sends DriveTo and StopDriving.
class RouteDrive
{
    enum class EPlace : std::uint8_t
    {
        AtNode,       ///< On the last node, or after a cancel somewhere near it.
        EdgeEntered,  ///< On the last node still; the actions of the first edge may run.
        BetweenNodes, ///< Driving on the first edge, or stopped there.
        EndReached,   ///< On the last node of a cancelled order, which is shown until the cancel is finished.
    };

    enum class EMotion : std::uint8_t
    {
        None,
        DrivingThrough, ///< DriveTo was sent last, to a node at which the vehicle does not stop.
        DrivingToStop,  ///< DriveTo was sent last.
        Halting,        ///< StopDriving was sent, and the vehicle is not stationary yet.
    };

    RemainingRoute _route;
    EPlace _place = EPlace::AtNode;
    EMotion _motion = EMotion::None;
    bool _bDriving = false; ///< Reported by the owner.
    bool _bLastLeg = false; ///< After a cancel, a line-guided vehicle drives to the next node.
    std::string _lastNodeID;
    std::uint32_t _lastNodeSequenceID = 0;
    std::optional<VehicleError> _corridorError; ///< Set while the vehicle is outside the corridor.

public:
    explicit RouteDrive(std::string lastNodeID);

    /// The vehicle is on the first node of the order: it is reached on acceptance and never in nodeStates.
    void Begin(const OrderNode& first);
    /// All but the first node, which the vehicle knows already.
    void Append(OrderMessage order);
    /// The first sequenceId that is dropped; nullopt without a horizon.
    [[nodiscard]] std::optional<std::uint32_t> DropHorizonOrNull();
    [[nodiscard]] bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory);

    /// False: the vehicle is on an edge already.
    [[nodiscard]] bool TryEnterEdge();
    /// Sends DriveTo to the first node, unless it was sent last.
    void DriveToFront(VehicleActions& out);
    /// 6.6.3: a cancelled vehicle that is bound to nodes still has one to reach.
    void DriveLastLeg(VehicleActions& out);
    void Stop(VehicleActions& out);
    void OnStationary();
    /// False: neither driving nor a stop has changed.
    [[nodiscard]] bool TryChangeDriving(bool bDriving);
    /// The vehicle has arrived at the first node. Without nodes a cancelled order would look like a completed one.
    void LeaveEdge(bool bCancelling);
    /// The first node becomes the last one that was reached.
    void PassFrontNode();
    void SetLastNode(std::string nodeID);
    /// False: the vehicle was outside, or inside, before.
    [[nodiscard]] bool TryChangeCorridor(bool bOutside, VehicleActions& out);

    /// Stops, unless the vehicle is bound to nodes and between two of them, be it paused: it drives on to the next one.
    void Cancel(bool bStopsBetweenNodes, VehicleActions& out);
    void Clear();
    void Forget(bool bBetweenNodes);

    [[nodiscard]] const RemainingRoute& GetRoute() const noexcept;
    [[nodiscard]] bool IsOnEdgeTo(std::uint32_t sequenceID) const;
    [[nodiscard]] bool IsBetweenNodes() const noexcept;
    [[nodiscard]] bool IsEndReached() const noexcept;
    [[nodiscard]] bool IsOnLastLeg() const noexcept;
    /// DriveTo was sent last.
    [[nodiscard]] bool IsLegActive() const noexcept;
    /// After StopDriving the vehicle counts as moving until the owner reports that it is stationary.
    [[nodiscard]] bool IsStationary() const noexcept;
    [[nodiscard]] bool HasCorridor() const;
    /// Whether there is a released node to drive to, inside of the corridor.
    [[nodiscard]] bool CanContinue() const;
    /// Whether a cancelled vehicle has come to its end: outside of its corridor it does not get to the next node by itself.
    [[nodiscard]] bool CanFinishCancel() const;
    [[nodiscard]] bool NeedsNewBase(std::size_t lowBaseNodes) const;
    void Fill(StateMessage& state, bool bEdgesShown) const;
    void Fill(OrderContext& context) const;

private:
    void SendDriveTo(bool bStopAtNode, VehicleActions& out);
    [[nodiscard]] bool NeedsStopAtFront() const;
    void Discard();
};

} // namespace ACS::VDA5050
