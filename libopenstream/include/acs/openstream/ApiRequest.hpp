#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/EApiMethod.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStream
{

/// One parameter of a query, unescaped as the peer wrote it.
struct QueryParameter
{
    std::string name;
    std::string value; ///< A string's text, or the JSON text of any other value.

    bool operator==(const QueryParameter&) const = default;
};

/// A call of the controller's Open API, the same whether it came over HTTP or in a MONITOR or CONTROL.
struct ApiRequest
{
    EApiMethod method = EApiMethod::Get;
    std::string path; ///< "/project/robot/po_cur", as it came: percent signs are not decoded.
    std::vector<QueryParameter> query;
    std::optional<Core::JsonText> body; ///< Nothing with a GET; `{}` with a CONTROL that named none.

    /// The value of the first parameter of this name; null where there is none.
    [[nodiscard]] const std::string* GetParameterOrNull(std::string_view name) const noexcept;

    bool operator==(const ApiRequest&) const = default;
};

/// The answer to an ApiRequest.
struct ApiResponse
{
    int status = 200; ///< HTTP; every 2xx is a success.
    std::optional<Core::JsonText> body;
    /// The server hands it on so much later, as if the call had taken that long: a service that is slow on purpose, or
    /// waits on behalf of another machine, need not keep the server's thread. What was asked for is done by then.
    Core::Duration delay{};
    /// To a MONITOR: there is nothing to show this time, no line is sent and the tick counts as skipped. So a controller
    /// falls silent while it changes its mode. Elsewhere it means nothing.
    bool bNoSample = false;

    [[nodiscard]] bool IsSuccess() const noexcept;

    /// Makes this 200 without a body, and gives back the text that its body had, emptied: the next one is written into it
    /// without taking room anew.
    [[nodiscard]] std::string TakeRoom();

    bool operator==(const ApiResponse&) const = default;
};

/// Takes "/path?name=value&name2=value2" apart: sets path and query of the request.
void SplitUrl(std::string_view url, ApiRequest& request);

/// Puts the arguments (text of a JSON object, as MONITOR and CONTROL carry them) into the query. An argument replaces a
/// parameter of the same name.
void AddArguments(const Core::JsonText& args, ApiRequest& request);

/// Path and query as a target for HTTP, the query's names and values percent-encoded.
[[nodiscard]] std::string BuildUrl(const ApiRequest& request);

} // namespace ACS::OpenStream
