#pragma once

#include <system_error>

namespace ACS::VDA5050
{

struct BrokerUp
{
};

struct BrokerDown
{
    std::error_code reason;
};

} // namespace ACS::VDA5050
