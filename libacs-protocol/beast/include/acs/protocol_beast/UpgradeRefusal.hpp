#pragma once

#include <acs/protocol_beast/HttpHeaders.hpp>

#include <string>

namespace ACS::ProtocolBeast
{

/// Why an McsServer refuses a client. The client receives it as its HTTP answer.
struct UpgradeRefusal
{
    unsigned status = 403; ///< 400 to 599; another one is sent as 403.
    std::string text{};    ///< Body of the answer, for a reader; may be empty.
    HttpHeaders headers{}; ///< Additional ones, such as WWW-Authenticate; left out if CheckHttpHeaders refuses them.
};

} // namespace ACS::ProtocolBeast
