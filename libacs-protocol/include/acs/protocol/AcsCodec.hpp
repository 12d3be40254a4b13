#pragma once

#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/CodecOptions.hpp>
#include <acs/protocol/DecodeOutcome.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// Text to message and back. Keeps its scratch memory between calls, so that no message costs more allocations than its
/// own strings and vectors. Not shared between threads.
class AcsCodec
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    explicit AcsCodec(const CodecOptions& options = {});
    AcsCodec(const AcsCodec&) = delete;
    AcsCodec& operator=(const AcsCodec&) = delete;
    ~AcsCodec();

    /// Total: any bytes give a message or a failure. Request or response is decided by the Ack suffix of the command
    /// alone (an MCS exists whose requests carry `"result":null`). Times are cut to the millisecond, the wire's own.
    [[nodiscard]] DecodeOutcome Decode(std::string_view text);

    /// Replaces out by the compact JSON of the message, in the document's member order and exact spellings.
    static void Encode(const AcsMessage& message, std::string& out);
    static void EncodeRequest(const AcsRequest& request, std::string& out);
    static void EncodeAck(const AcsAck& ack, std::string& out);

    /// The refusal of a command that AcsAck cannot name: `commandName` + Ack, Fail, empty payload.
    static void EncodeRefusal(
        std::string_view commandName,
        std::string_view transactionID,
        const Core::Timestamp& timestamp,
        std::string_view reason,
        std::string& out);
};

} // namespace ACS::Protocol
