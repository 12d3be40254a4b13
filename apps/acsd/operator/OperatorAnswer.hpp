#pragma once

#include "common/http/HttpMessage.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Codes of the answers of the operator API.
struct OperatorCode
{
    static constexpr unsigned OK = 200;
    static constexpr unsigned ACCEPTED = 202;
    static constexpr unsigned BAD_REQUEST = 400;
    static constexpr unsigned NOT_FOUND = 404;
    static constexpr unsigned CONFLICT = 409;
    static constexpr unsigned UNAVAILABLE = 503;
};

/// {"error":"…"}
[[nodiscard]] Apps::HttpResponse MakeOperatorError(unsigned status, std::string_view sentence);

/// 404 of a plan or a robot that does not exist; kind: "plan" or "robot".
[[nodiscard]] Apps::HttpResponse RefuseUnknown(std::string_view kind, std::string_view id);

/// 202 {"message":"…"}
[[nodiscard]] Apps::HttpResponse MakeAccepted(std::string_view sentence);

/// 200 with a JSON text.
[[nodiscard]] Apps::HttpResponse MakeJsonAnswer(std::string body);

/// Why the query has parameters that the request does not have, or has one twice; nullopt if it is valid. They are refused
/// rather than ignored, because the answer would be another one than intended.
[[nodiscard]] std::optional<std::string> FindUnexpectedParameterOrNull(
    const Apps::HttpRequest& request,
    std::initializer_list<std::string_view> known);

} // namespace ACS::Acsd
