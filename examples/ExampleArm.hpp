#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/openstream/EApiMethod.hpp>
#include <acs/openstream/OpenStreamLines.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <boost/json/src.hpp> // The whole library, for the one source of a lesson.
#include <boost/system/error_code.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A controller as the command line names it; null where the text is no port.
inline std::optional<ACS::OpenStreamAsio::OpenStreamClientOptions> ReadControllerOrNull(
    std::string host,
    std::string_view port)
{
    ACS::OpenStreamAsio::OpenStreamClientOptions options;
    options.host = std::move(host);
    options.port = ACS::Core::ParseNumberOrNull<std::uint16_t>(port).value_or(0);
    return options.port != 0 ? std::optional(std::move(options)) : std::nullopt;
}

/// The numbers of an array in an answer of the Open API: of this member of an object, or of the answer itself if the name
/// is empty. Null if the answer has another form. The SDK passes answers through as text: a program brings its own reader.
inline std::optional<std::vector<double>> ReadNumbersOrNull(
    const ACS::Core::JsonText& answer,
    std::string_view member = {})
{
    boost::system::error_code error;
    const boost::json::value value = boost::json::parse(answer.GetText(), error);
    const boost::json::object* const objectOrNull = value.if_object();
    const boost::json::value* arrayOrNull = member.empty() ? &value : nullptr;
    if (objectOrNull != nullptr && !member.empty())
    {
        arrayOrNull = objectOrNull->if_contains(member);
    }
    if (error || arrayOrNull == nullptr || !arrayOrNull->is_array())
    {
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (const boost::json::value& element : arrayOrNull->get_array())
    {
        if (!element.is_number())
        {
            return std::nullopt;
        }
        numbers.push_back(element.to_number<double>());
    }
    return numbers;
}

/// Likewise of a sample; empty if the sample has no such numbers.
inline std::vector<double> ReadSample(const ACS::OpenStream::DataLine& sample, std::string_view member = {})
{
    return ReadNumbersOrNull(sample.result.value_or(ACS::Core::JsonText()), member).value_or(std::vector<double>());
}

/// A POST of the Open API. The body is a JSON object that the lesson has composed.
inline ACS::OpenStream::ControlRequest MakePost(std::string url, std::string body)
{
    return {
        ACS::OpenStream::EApiMethod::Post,
        std::move(url),
        std::nullopt,
        ACS::Core::JsonText::FromTrusted(std::move(body))};
}
