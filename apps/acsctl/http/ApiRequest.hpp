#pragma once

#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// A request of the operator API.
struct ApiRequest
{
    std::string method = "GET";
    std::string target;           ///< "/v1/plans?limit=10"
    std::string body{};           ///< JSON; empty: none.
    std::string idempotencyKey{}; ///< Of a POST.
};

/// A complete answer.
struct ApiAnswer
{
    unsigned status = 0;
    std::string contentType;
    std::string body;
    std::string retryAfter; ///< Header Retry-After; empty without one.
};

/// The text as one segment of a path or as a value of a query.
[[nodiscard]] std::string EncodePercent(std::string_view text);

} // namespace ACS::Acsctl
