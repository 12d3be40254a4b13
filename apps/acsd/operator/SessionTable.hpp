#pragma once

#include "operator/OperatorToken.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

namespace ACS::Acsd
{

/// The sessions of browsers, bounded in number and duration: which token each has been opened with. Neither a secret nor a
/// token is kept, only its SHA-256. Pure.
class SessionTable final
{
public:
    using Hash = OperatorToken::Hash;

    static constexpr std::chrono::hours LIFETIME{12};
    /// The oldest is dropped.
    static constexpr std::size_t MOST_SESSIONS = 256;
    static constexpr std::size_t MOST_PER_TOKEN = 32;

private:
    struct Session
    {
        Hash secret{};
        Hash token{};
        Core::SteadyTime openedAt;
    };

    std::vector<Session> _sessions; ///< The oldest first.

public:
    void Add(const Hash& secret, const Hash& token, Core::SteadyTime now);

    /// The token of the session; nullopt if there is none, or not any more.
    [[nodiscard]] std::optional<Hash> FindTokenOrNull(const Hash& secret, Core::SteadyTime now) const;

    void Remove(const Hash& secret);
};

} // namespace ACS::Acsd
