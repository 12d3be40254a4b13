#pragma once

#include <acs/core/Api.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/CodecOptions.hpp>
#include <acs/protocol/DecodeOutcome.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// Converts texts to messages and back. Reuses its buffers: a message costs no allocations except for its own strings and
/// vectors. Not shared between threads.
class ACS_API AcsCodec
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The options apply to Decode only.
    explicit AcsCodec(const CodecOptions& options = {});
    AcsCodec(const AcsCodec&) = delete;
    AcsCodec& operator=(const AcsCodec&) = delete;
    ~AcsCodec();

    /// CodecOptions::siteOffset of the next texts.
    void SetSiteOffset(std::chrono::minutes offset) noexcept;

    /// Any bytes result in a message or a failure. Only the Ack suffix of the command distinguishes a response from a
    /// request (an MCS exists whose requests carry `"result":null`). Times are truncated to milliseconds.
    [[nodiscard]] DecodeOutcome Decode(std::string_view text);

    /// Replaces out by the compact JSON of the message, with members in the order of the specification. Numbers must be
    /// finite: another one is written as null, and the receiver refuses the message.
    static void Encode(const AcsMessage& message, std::string& out);
    /// As Encode, without a variant around the message.
    static void EncodeRequest(const AcsRequest& request, std::string& out);
    /// As Encode, without a variant around the message.
    static void EncodeAck(const AcsAck& ack, std::string& out);

    /// Fail for a command that is not an EAcsCommand: `commandName` + Ack, empty payload.
    static void EncodeRefusal(
        std::string_view commandName,
        std::string_view transactionID,
        const Core::Timestamp& timestamp,
        std::string_view reason,
        std::string& out);
};

} // namespace ACS::Protocol
