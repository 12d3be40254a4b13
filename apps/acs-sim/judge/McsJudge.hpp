#pragma once

#include "judge/MessageEnvelope.hpp"
#include "judge/RuleBook.hpp"
#include "judge/SentRequest.hpp"
#include <acs/core/Now.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/DecodeOutcome.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// Judges an MCS by every text of both directions. Pure: the caller passes the time, and calls OnTick from time to time.
class McsJudge
{
public:
    static constexpr std::size_t MOST_REMEMBERED = 4096; ///< Answered requests, and requests of the MCS.

private:
    Core::Duration _ackTimeout;
    RuleBook _book;
    Protocol::AcsCodec _codec;
    Json::JsonDocument _document;
    std::map<std::string, SentRequest, std::less<>> _sent; ///< By transactionID, like the next.
    std::map<std::string, Protocol::AcsPayload, std::less<>> _received;
    std::map<std::string, ReceivedPlan, std::less<>> _plans; ///< By planID.
    std::deque<std::string> _answered;                       ///< transactionIDs, oldest first, like the next.
    std::deque<std::string> _requests;
    std::uint64_t _order = 0;
    std::uint64_t _connection = 0;
    std::uint64_t _lastCommState = 0;        ///< The order of the last AcsCommStateUpdate.
    std::optional<std::uint64_t> _malformed; ///< The order of a malformed text after which nothing was answered yet.
    bool _bRegistered = false;
    bool _bWithheld = false; ///< The MCS has acknowledged isConnected=false.

public:
    /// @param ackTimeout Maximum time to an Ack.
    explicit McsJudge(Core::Duration ackTimeout = std::chrono::seconds(5));

    /// @param bByACS The ACS has closed or broken the connection. A Registration that is sent begins the next one.
    void OnClosed(bool bByACS);
    void OnSent(std::string_view text, Core::SteadyTime now);
    void OnReceived(std::string_view text, Core::SteadyTime now);
    void OnTick(Core::SteadyTime now);

    /// The MCS may answer this request as it likes: the ACS has sent it at a wrong time. Call before OnSent.
    void Excuse(const std::string& transactionID);

    /// Whether requests wait for their Ack.
    [[nodiscard]] bool HasOpenRequests() const;
    [[nodiscard]] RuleBook& GetBook();

private:
    void OnConnected();
    void OnAnswerSent(const Protocol::DecodeOutcome& outcome);
    [[nodiscard]] SentRequest MakeSent(const std::string& command, const Protocol::DecodeOutcome& outcome) const;
    [[nodiscard]] bool IsKnownReport(const Protocol::AcsPayload& payload) const;

    void OnAck(const MessageEnvelope& envelope, Core::SteadyTime now);
    [[nodiscard]] SentRequest* FindSentOrNull(const MessageEnvelope& envelope);
    void JudgeResult(SentRequest& sent, Protocol::EAckResult result, const std::string& name);
    void Close(SentRequest& sent, const std::string& transactionID);

    void OnRequest(const MessageEnvelope& envelope, Protocol::DecodeOutcome outcome);
    void OnRequestFailure(const Protocol::DecodeFailure& failure);
    /// False: it is a repetition.
    [[nodiscard]] bool IsNewRequest(const Protocol::AcsRequest& request);
    void OnPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID);
    void OnControl(std::string_view command, const std::string& planID);

    void Judge(ERule rule, bool bKept, const std::string& text);
};

} // namespace ACS::AcsSim
