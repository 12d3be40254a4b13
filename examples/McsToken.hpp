#pragma once

#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <fmt/core.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Whether the texts are equal; the time that this takes does not depend on where they differ.
[[nodiscard]] inline bool IsSameSecret(std::string_view left, std::string_view right)
{
    unsigned difference = left.size() == right.size() ? 0U : 1U;
    for (std::size_t index = 0; index < left.size() && index < right.size(); ++index)
    {
        difference |=
            static_cast<unsigned char>(left[index]) ^ static_cast<unsigned>(static_cast<unsigned char>(right[index]));
    }
    return difference == 0;
}

/// Accepts clients with "Authorization: Bearer TOKEN"; nullptr accepts every client.
[[nodiscard]] inline ACS::ProtocolBeast::UpgradeCheck MakeTokenCheck(const char* tokenOrNull)
{
    using ACS::ProtocolBeast::UpgradeRefusal;
    using ACS::ProtocolBeast::UpgradeRequest;
    if (tokenOrNull == nullptr)
    {
        return {};
    }
    return [expected =
                std::string("Bearer ") + tokenOrNull](const UpgradeRequest& request) -> std::optional<UpgradeRefusal> {
        const std::string* const givenOrNull = ACS::ProtocolBeast::FindHeaderOrNull(request.headers, "Authorization");
        if (givenOrNull != nullptr && IsSameSecret(*givenOrNull, expected))
        {
            return std::nullopt;
        }
        fmt::print("refused: {} has not the token\n", request.peerAddress);
        return UpgradeRefusal{401, "A valid token is required.\n", {{"WWW-Authenticate", "Bearer"}}};
    };
}
