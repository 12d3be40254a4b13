#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// A request to cancel, abort, pause or resume a plan, its result report, and the state of the plan after a Success.
struct ControlRule
{
    Protocol::EAcsCommand request;
    Protocol::EAcsCommand result;
    Protocol::EPlanStatus status;
};

/// The rule of a result report.
[[nodiscard]] const ControlRule& GetControlRule(Protocol::EAcsCommand result);

/// The requests of the MCS to cancel, abort, pause or resume plans that have no result report yet (sections 6.5 to 6.8).
/// Each request allows one. Pure.
class ControlRequests
{
public:
    enum class EResultOrigin : std::uint8_t
    {
        Request,     ///< Of a request that was not refused.
        Interrupted, ///< As Request, and the connection was lost after it was sent.
        Refused,     ///< Of a request that was acknowledged with Fail.
        None,
    };

private:
    struct OpenRequest
    {
        Protocol::EAcsCommand command;
        std::string planID;
        std::string transactionID;
        bool bRefused = false;
        bool bInterrupted = false;                  ///< The connection was lost since.
        std::optional<Core::WallTime> acceptedAt{}; ///< Timestamp of its Ack Success, by the clock of the ACS.
    };

    std::vector<OpenRequest> _open; ///< In the order of sending.

public:
    /// Any request that was sent. The repetition of an open one is no other request.
    void OnSent(const Protocol::AcsRequest& request);

    /// Any Ack of the ACS.
    void OnAck(const Protocol::AcsAck& ack);
    void OnLinkLost();

    /// Whether the ACS had accepted an AbortPlan of this plan before this time of its clock, and has not reported the result.
    [[nodiscard]] bool IsAborting(const std::string& planID, Core::WallTime time) const;

    /// Closes the request that a result report belongs to. A Failed belongs to a refused request, if there is one.
    [[nodiscard]] EResultOrigin Close(Protocol::EAcsCommand result, const std::string& planID, bool bSuccess);
};

} // namespace ACS::McsSim
