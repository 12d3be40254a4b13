#pragma once

#include <string>

namespace ACS::Acsd
{

/// The header Idempotency-Key of a command whose answer is kept, as the audit log records it.
struct CommandKey
{
    std::string key{};    ///< Empty: the command has none, or its answer is not kept.
    std::string digest{}; ///< SHA-256 of method, target and body, in hexadecimal.
    bool bReplay = false; ///< Answered as before, and not executed again.
};

} // namespace ACS::Acsd
