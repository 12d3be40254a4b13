#pragma once

#include "common/http/HttpMessage.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/CommandKey.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The answers to commands with the header Idempotency-Key, bounded in number and time: a client that got no answer sends its
/// command again, and it is executed once. A key belongs to the name that sent it. Pure.
class IdempotencyKeys final
{
public:
    static constexpr std::chrono::minutes KEPT{10};
    /// The oldest is dropped.
    static constexpr std::size_t MOST_KEYS = 1'000;

    struct Answer
    {
        Apps::HttpResponse response;
        CommandKey key{};
    };

private:
    struct Kept
    {
        std::string owner;
        std::string key;
        std::string digest;
        Apps::HttpResponse response;
        Core::SteadyTime answeredAt;
    };

    std::deque<Kept> _answers; ///< The oldest first.

public:
    /// Calls `respond`, or returns the kept answer of the same request with the header Idempotent-Replay. 409 if the key has
    /// been used for another request, 400 if it is invalid. Answers of 500 and above are not kept.
    [[nodiscard]] Answer Respond(
        const Apps::HttpRequest& request,
        const OperatorIdentity& identity,
        Core::SteadyTime now,
        const std::function<Apps::HttpResponse()>& respond);

    /// Keeps the answers of the lines of the audit log, the oldest first, that are recent enough.
    void Restore(std::string_view auditLines, Core::Now now);

private:
    [[nodiscard]] const Kept* FindOrNull(const std::string& owner, const std::string& key) const;
    void Add(Kept answer);
    void RestoreLine(std::string_view text, Core::Now now);
};

} // namespace ACS::Acsd
