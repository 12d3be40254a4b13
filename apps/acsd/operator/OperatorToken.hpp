#pragma once

#include "operator/EOperatorRole.hpp"
#include <acs/core/Result.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A line of the file of tokens: who has the token, and its SHA-256. The token itself is not kept anywhere: a
/// reader of the file cannot use it.
struct OperatorToken
{
    static constexpr std::size_t HASH_BYTES = 32;
    using Hash = std::array<std::uint8_t, HASH_BYTES>;

    EOperatorRole role = EOperatorRole::Viewer;
    std::string name;
    Hash hash{};

    bool operator==(const OperatorToken&) const = default;
};

/// Of "viewer" and "operator".
[[nodiscard]] std::optional<EOperatorRole> ReadRoleOrNull(std::string_view word);
[[nodiscard]] std::string_view GetText(EOperatorRole role);

/// Whether the name of a token or a certificate can be given: 1 to 64 of A-Z a-z 0-9 . _ - @
[[nodiscard]] bool IsOperatorName(std::string_view name);

/// The SHA-256 of the text.
[[nodiscard]] OperatorToken::Hash HashToken(std::string_view token);

/// The token of 32 random bytes as text: base64url without padding.
[[nodiscard]] std::string MakeTokenText(const std::array<std::uint8_t, OperatorToken::HASH_BYTES>& random);

/// "operator kim 3a7b…", without line end.
[[nodiscard]] std::string MakeTokenLine(const OperatorToken& token);

/// Reads lines `ROLE NAME SHA256`; empty lines and lines that begin with # are skipped. A name may have several tokens.
/// The error names the line.
[[nodiscard]] Core::Result<std::vector<OperatorToken>> ParseTokens(std::string_view text);

} // namespace ACS::Acsd
