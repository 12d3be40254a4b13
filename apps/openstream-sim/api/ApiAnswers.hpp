#pragma once

#include "api/ApiFields.hpp"
#include "api/EApiError.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/openstream/ApiRequest.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamSim
{

inline constexpr std::string_view OBJECT_TYPE = "JObject";

/// 200 with an object that carries its "_type", written into the text, which is empty.
template <typename TAnswer>
[[nodiscard]] OpenStream::ApiResponse Succeed(
    const TAnswer& answer,
    std::string_view type = OBJECT_TYPE,
    std::string text = {})
{
    Json::JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("_type");
    writer.WriteString(type);
    Json::EncodeMembers(answer, writer);
    writer.EndObject();
    return OpenStream::ApiResponse{200, Core::JsonText::FromTrusted(std::move(text))};
}

/// 200 with {"_type":"JObject"}.
[[nodiscard]] OpenStream::ApiResponse Succeed();

/// 403 with the code and a sentence, for a call that is not allowed now; success for None.
[[nodiscard]] OpenStream::ApiResponse Answer(EApiError error);

/// 403 for endpoints with their own number or sentence.
[[nodiscard]] OpenStream::ApiResponse Forbid(std::int32_t code, std::string sentence);

/// 400
[[nodiscard]] OpenStream::ApiResponse Refuse(const Core::Error& error);

/// 400 with the parameter or member, the expected and the found value.
[[nodiscard]] OpenStream::ApiResponse RefuseInput(std::string name, std::string expected, std::string found);

/// 404
[[nodiscard]] OpenStream::ApiResponse RefusePath(const std::string& sentence);

/// A whole number of the query, or the default if it is absent.
[[nodiscard]] Core::Result<std::int64_t> ReadInteger(
    const OpenStream::ApiRequest& request,
    std::string_view name,
    std::int64_t byDefault,
    std::int64_t lowest,
    std::int64_t highest);

/// Reads the body into the message, which has the defaults.
template <typename TMessage>
[[nodiscard]] Core::Result<TMessage> ReadBody(const OpenStream::ApiRequest& request, TMessage message = {})
{
    const std::string text = request.body.has_value() ? request.body->GetText() : "{}";
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text, Json::ParseLimits{});
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeContext context;
    if (!Json::TryDecode(**root, message, Json::FieldBounds{}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return message;
}

} // namespace ACS::OpenStreamSim
