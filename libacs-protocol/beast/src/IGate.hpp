#pragma once

#include "ILink.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// What an HTTP request at the beginning of a connection asks for.
struct UpgradeRequest
{
    std::string_view target;
    bool bWebSocket = false;
};

/// Why a request is refused.
struct UpgradeRefusal
{
    unsigned status = 0; ///< Of HTTP.
    std::string text;
};

/// Who owns a gate. Called on the executor, never from within a call of the owner; nothing after onAccepted, onEnded or
/// Kill.
struct GateOwner
{
    std::function<std::optional<UpgradeRefusal>(const UpgradeRequest& request)> judge;
    std::function<void(const std::string& reason)> onRefused;    ///< Somebody should know; onEnded follows.
    std::function<void(std::shared_ptr<ILink> link)> onAccepted; ///< The link opens next.
    std::function<void()> onEnded;                               ///< Without a link.
};

/// The beginning of a connection to a server: TLS where it has it, then the HTTP request.
class IGate
{
public:
    IGate() = default;
    IGate(const IGate&) = delete;
    IGate& operator=(const IGate&) = delete;
    virtual ~IGate() = default;

    virtual void RunAsync() = 0;

    /// Closes the socket; the owner hears nothing any more.
    virtual void Kill() = 0;
};

} // namespace ACS::ProtocolBeast
