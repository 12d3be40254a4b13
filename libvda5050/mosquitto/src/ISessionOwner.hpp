#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <system_error>
#include <variant>
#include <vector>

namespace ACS::VDA5050
{

struct BrokerUp
{
};

struct BrokerDown
{
    std::error_code reason;
};

/// A client with a SessionOnBroker.
template <typename TSession, typename TAction>
class ACS_HIDDEN ISessionOwner
{
public:
    using Event = std::variant<BrokerUp, BrokerDown, TAction>;

    ISessionOwner() = default;
    ISessionOwner(const ISessionOwner&) = delete;
    ISessionOwner& operator=(const ISessionOwner&) = delete;
    virtual ~ISessionOwner() = default;

    /// Carries out a request of the session, or pushes an event.
    virtual void Execute(const TAction& action) = 0;
    virtual void Deliver(const Event& event) = 0;
    virtual void CancelTimers() = 0;
    /// The last call of the session.
    virtual void EndSession(TSession& session, Core::Now now, std::vector<TAction>& out) = 0;
    /// Before the first connection, and on each one for the next.
    virtual void PrepareConnection(TSession& session, MosquittoLink& link, Core::Now now) = 0;
};

} // namespace ACS::VDA5050
