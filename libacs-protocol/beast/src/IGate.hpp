#pragma once

#include "ILink.hpp"
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <functional>
#include <memory>
#include <string>
#include <variant>

namespace ACS::ProtocolBeast
{

/// What becomes of an accepted client.
struct GateAcceptance
{
    LinkOwner linkOwner;
    std::function<void(std::shared_ptr<ILink> link)> onAccepted; ///< The link opens next.
};

using GateDecision = std::variant<UpgradeRefusal, GateAcceptance>;

/// The owner of a gate. Called on the executor, never during a call of the owner, and not after onAccepted, onEnded or Kill.
struct GateOwner
{
    /// The request has neither connection nor peer, which the owner knows.
    std::function<GateDecision(UpgradeRequest request, bool bWebSocket)> decide;
    std::function<void(const std::string& reason)> onRefused; ///< To be logged; onEnded follows.
    std::function<void()> onEnded;                            ///< Without a link.
};

/// The start of a connection to a server: TLS if configured, then the HTTP request.
class IGate
{
public:
    IGate() = default;
    IGate(const IGate&) = delete;
    IGate& operator=(const IGate&) = delete;
    virtual ~IGate() = default;

    virtual void RunAsync() = 0;

    /// Closes the socket; the owner is not called any more.
    virtual void Kill() = 0;
};

} // namespace ACS::ProtocolBeast
