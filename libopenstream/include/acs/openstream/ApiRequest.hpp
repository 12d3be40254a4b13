#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/EApiMethod.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStream
{

/// One parameter of a query, without percent-encoding.
struct QueryParameter
{
    std::string name;  ///< May occur more than once.
    std::string value; ///< A string's text, or the JSON text of any other value.

    bool operator==(const QueryParameter&) const = default;
};

/// A call of the controller's Open API, the same whether it came over HTTP or in a MONITOR or CONTROL.
struct ACS_API ApiRequest
{
    EApiMethod method = EApiMethod::Get; ///< As in HTTP.
    std::string path;                   ///< For example "/project/robot/po_cur"; as received, without percent-decoding.
    std::vector<QueryParameter> query;  ///< In the order of the URL.
    std::optional<Core::JsonText> body; ///< None for a GET; `{}` for a CONTROL without one.

    /// The value of the first parameter of this name; null if there is none.
    [[nodiscard]] const std::string* GetParameterOrNull(std::string_view name) const noexcept;

    bool operator==(const ApiRequest&) const = default;
};

/// The answer to an ApiRequest.
struct ACS_API ApiResponse
{
    int status = 200;                   ///< HTTP; every 2xx is a success.
    std::optional<Core::JsonText> body; ///< Absent: an answer without content.
    /// The server delays the answer by this time, as if the call had taken that long: a service that is deliberately slow
    /// does not block the server's thread. The call itself is complete.
    Core::Duration delay{};
    /// For a MONITOR: no data this time. No line is sent and the period counts as skipped, as on a controller that changes
    /// its mode. Otherwise ignored.
    bool bNoSample = false;

    /// Whether the status is 2xx.
    [[nodiscard]] bool IsSuccess() const noexcept;

    /// Resets this to 200 without a body, and returns the emptied buffer of the former body for reuse without an
    /// allocation.
    [[nodiscard]] std::string TakeRoom();

    bool operator==(const ApiResponse&) const = default;
};

/// Parses "/path?name=value&name2=value2" into path and query of the request. Names and values are decoded like those of
/// HTTP: percent-encoding, and '+' as a blank. An invalid escape stays as it is. The path is not decoded.
ACS_API void SplitURL(std::string_view url, ApiRequest& request);

/// Adds the arguments (a JSON object, as in MONITOR and CONTROL) to the query. An argument replaces a parameter of the same
/// name.
ACS_API void AddArguments(const Core::JsonText& args, ApiRequest& request);

/// Path and query as an HTTP target, with percent-encoded names and values.
[[nodiscard]] ACS_API std::string BuildURL(const ApiRequest& request);

} // namespace ACS::OpenStream
