#pragma once

#include "common/http/HttpMessage.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/CommandKey.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/CommandReceipt.hpp>

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The answers to commands with the header Idempotency-Key, bounded in number and time as CommandReceipt: a client that got no
/// answer sends its command again, and it is executed once. A key belongs to the name that sent it. Pure.
class IdempotencyKeys final
{
public:
    struct Answer
    {
        Apps::HttpResponse response;
        CommandKey key{};
    };

private:
    struct UsedKey
    {
        std::string owner;
        std::string key;
        std::string digest;
    };

    struct Kept
    {
        UsedKey used;
        Apps::HttpResponse response;
        Core::SteadyTime answeredAt;
    };

    std::deque<Kept> _answers;       ///< The oldest first.
    std::optional<UsedKey> _current; ///< Of the request that is being answered.

public:
    /// Calls `respond`, or returns the kept answer of the same request with the header Idempotent-Replay. 409 if the key has
    /// been used for another request, 400 if it is invalid. Answers of 500 and above are not kept.
    [[nodiscard]] Answer Respond(
        const Apps::HttpRequest& request,
        const OperatorIdentity& identity,
        Core::SteadyTime now,
        const std::function<Apps::HttpResponse()>& respond);

    /// For Restore in a later process, while `respond` is called; nullopt if the request has no key.
    [[nodiscard]] std::optional<Planning::CommandReceipt> MakeReceiptOrNull(
        const Apps::HttpResponse& answer,
        Core::WallTime now) const;

    /// Drops the answer of the receipt, also during `respond`: the same request with the same key is executed again.
    void Forget(const Planning::CommandReceipt& receipt);

    /// Keeps the answers of the receipts, the oldest first, that are recent enough.
    void Restore(const std::vector<Planning::CommandReceipt>& receipts, Core::Now now);

private:
    [[nodiscard]] const Kept* FindOrNull(const std::string& owner, const std::string& key) const;
    void Add(Kept answer);
};

} // namespace ACS::Acsd
