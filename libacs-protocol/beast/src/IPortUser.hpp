#pragma once

#include "ILink.hpp"
#include <acs/protocol/SessionEvent.hpp>
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace ACS::ProtocolBeast
{

/// A server at a port. Called on the executor.
class IPortUser
{
public:
    IPortUser() = default;
    IPortUser(const IPortUser&) = delete;
    IPortUser& operator=(const IPortUser&) = delete;
    virtual ~IPortUser() = default;

    /// Of its clients; empty: every path.
    [[nodiscard]] virtual const std::string& GetPath() const = 0;
    [[nodiscard]] virtual std::optional<UpgradeRefusal> JudgeOrNull(const UpgradeRequest& request) const = 0;
    [[nodiscard]] virtual LinkOwner MakeLinkOwner(Protocol::ConnectionID connection) = 0;
    virtual void OnAccepted(Protocol::ConnectionID connection, std::shared_ptr<ILink> link) = 0;
    [[nodiscard]] virtual std::size_t CountLinks() const = 0;
};

} // namespace ACS::ProtocolBeast
