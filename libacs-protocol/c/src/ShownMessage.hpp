#pragma once

#include <acs/c/acs_protocol.h>
#include <acs/protocol/DecodeOutcome.hpp>

#include <cstdint>
#include <string>

namespace ACS::CInterface
{

/// The texts of the acs_message that a handle has shown last.
class ShownMessage
{
    std::int32_t _kind = ACS_KIND_INVALID;
    std::int32_t _result = ACS_RESULT_SUCCESS;
    std::uint32_t _notes = 0;
    std::string _command;
    std::string _transactionID;
    std::string _text;
    std::string _message;
    std::string _errorSentence;
    Core::Error _error;

public:
    /// The result is ACS_OK, or ACS_ERROR_MESSAGE for a text that is not a message.
    [[nodiscard]] std::int32_t Assign(const Protocol::DecodeOutcome& outcome);

    void Show(acs_message& out) const;
};

} // namespace ACS::CInterface
