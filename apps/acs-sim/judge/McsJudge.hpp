#pragma once

#include "judge/AckJudge.hpp"
#include "judge/RequestJudge.hpp"
#include "judge/RuleBook.hpp"
#include <acs/core/Now.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <chrono>
#include <set>
#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// Judges an MCS by every text of both directions. Pure: the caller passes the time, and calls OnTick from time to time.
class McsJudge
{
    RuleBook _book;
    Protocol::AcsCodec _codec;
    Json::JsonDocument _document;
    AckJudge _acks;
    RequestJudge _requests;

public:
    /// @param ackTimeout Maximum time to an Ack.
    explicit McsJudge(Core::Duration ackTimeout = std::chrono::seconds(5));
    McsJudge(const McsJudge&) = delete;
    McsJudge& operator=(const McsJudge&) = delete;
    ~McsJudge() = default;

    /// @param bByACS The ACS has closed or broken the connection. A Registration that is sent begins the next one.
    void OnClosed(bool bByACS);
    void OnSent(std::string_view text, Core::SteadyTime now);
    void OnReceived(std::string_view text, Core::SteadyTime now);
    void OnTick(Core::SteadyTime now);

    /// The MCS may answer this request as it likes: the ACS has sent it at a wrong time. Call before OnSent.
    void Excuse(const std::string& transactionID);

    /// Whether the Ack of this request is missing for too long.
    [[nodiscard]] bool IsOverdue(const std::string& transactionID) const;
    /// The transactionIDs of requests that wait for their Ack.
    [[nodiscard]] std::set<std::string> ListOpenRequests() const;
    [[nodiscard]] RuleBook& GetBook();
};

} // namespace ACS::AcsSim
