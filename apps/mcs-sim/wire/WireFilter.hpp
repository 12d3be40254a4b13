#pragma once

#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <optional>
#include <string_view>

namespace ACS::McsSim
{

/// Which of the texts on the wire come from the registered ACS. Pure; sees every text of a server, in its order.
class WireFilter
{
    Protocol::AcsCodec _codec;
    std::optional<Protocol::ConnectionID> _registered;

public:
    /// Whether the text is for a scenario: it came from the connection whose registration was accepted last, or is the
    /// registration of any.
    [[nodiscard]] bool ShouldPass(
        ProtocolBeast::EWireDirection direction,
        Protocol::ConnectionID connection,
        std::string_view text);

private:
    [[nodiscard]] bool IsAcceptance(std::string_view text);
    [[nodiscard]] bool IsRegistration(std::string_view text);
};

} // namespace ACS::McsSim
