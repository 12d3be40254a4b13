#include "SchemaCheck.hpp"

#include "Catch.hpp"
#include <acs/core/Timestamp.hpp>

#include <rapidjson/document.h>
#include <rapidjson/error/en.h>
#include <rapidjson/schema.h>
#include <rapidjson/stringbuffer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ACS::Testing
{

namespace
{

using VDA5050::ETopic;
using VDA5050::EVda5050Version;

constexpr std::array VERSIONS{EVda5050Version::Version200, EVda5050Version::Version210};
constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;

/// Keywords that the validator follows, that are checked here ("format"), or that say nothing about a payload.
constexpr std::array<std::string_view, 17> KNOWN_KEYWORDS{
    "$ref",
    "$schema",
    "additionalProperties",
    "definitions",
    "description",
    "enum",
    "examples",
    "format",
    "items",
    "maximum",
    "minimum",
    "properties",
    "required",
    "subtopic",
    "title",
    "type",
    "unit"};

std::string_view GetText(const rapidjson::Value& value)
{
    return {value.GetString(), value.GetStringLength()};
}

std::filesystem::path GetSchemaFolder()
{
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no test changes its environment
    const char* folder = std::getenv("ACS_SPEC_DIR");
    return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder) / "vda5050" / "schemas";
}

/// Closes every object that names its members; one without names ("data", "localizationParameters") is free by intent.
/// The one format that is checked is the timestamp of the header, which CheckHeader looks at.
void CloseObjects(rapidjson::Document& schema)
{
    struct Place
    {
        rapidjson::Value* schema;
        std::string_view name;
    };
    std::vector<Place> open{{&schema, ""}};
    while (!open.empty())
    {
        const Place place = open.back();
        open.pop_back();
        rapidjson::Value& node = *place.schema;
        if (!node.IsObject())
        {
            throw std::runtime_error("a schema that is no object: " + std::string(place.name));
        }
        if (node.HasMember("properties") && !node.HasMember("additionalProperties"))
        {
            node.AddMember("additionalProperties", false, schema.GetAllocator());
        }
        for (auto& member : node.GetObject())
        {
            const std::string_view keyword = GetText(member.name);
            if (std::ranges::find(KNOWN_KEYWORDS, keyword) == KNOWN_KEYWORDS.end()
                || (keyword == "format" && (place.name != "timestamp" || GetText(member.value) != "date-time")))
            {
                throw std::runtime_error("a schema asks for what is not checked: " + std::string(keyword));
            }
            if (keyword == "items")
            {
                open.push_back({&member.value, keyword});
            }
            if (keyword == "properties" || keyword == "definitions")
            {
                for (auto& inner : member.value.GetObject())
                {
                    open.push_back({&inner.value, GetText(inner.name)});
                }
            }
        }
    }
}

std::unique_ptr<rapidjson::SchemaDocument> LoadSchema(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    rapidjson::Document schema;
    schema.Parse<FLAGS>(text.data(), text.size());
    if (schema.HasParseError())
    {
        throw std::runtime_error("no schema in " + path.string());
    }
    CloseObjects(schema);
    return std::make_unique<rapidjson::SchemaDocument>(schema);
}

/// All schemas, read once.
class SchemaShelf
{
    std::array<std::array<std::unique_ptr<rapidjson::SchemaDocument>, VDA5050::TOPIC_COUNT>, VERSIONS.size()> _schemas;

public:
    SchemaShelf()
    {
        for (const EVda5050Version version : VERSIONS)
        {
            const std::string folder = std::string(VDA5050::GetVersionText(version)) + "-repaired";
            for (std::size_t index = 0; index < VDA5050::TOPIC_COUNT; ++index)
            {
                const auto topic = static_cast<ETopic>(index);
                const std::string name = std::string(VDA5050::GetTopicName(topic)) + ".schema";
                _schemas.at(static_cast<std::size_t>(version)).at(index) =
                    LoadSchema(GetSchemaFolder() / folder / name);
            }
        }
    }

    [[nodiscard]] const rapidjson::SchemaDocument& GetSchema(EVda5050Version version, ETopic topic) const
    {
        return *_schemas.at(static_cast<std::size_t>(version)).at(static_cast<std::size_t>(topic));
    }
};

/// A name that stands twice in one object: JSON parsers differ in which of the two they take.
std::optional<std::string> FindDoubleNameOrNull(const rapidjson::Value& root)
{
    std::vector<const rapidjson::Value*> open{&root};
    while (!open.empty())
    {
        const rapidjson::Value& value = *open.back();
        open.pop_back();
        if (value.IsArray())
        {
            for (const auto& item : value.GetArray())
            {
                open.push_back(&item);
            }
        }
        if (value.IsObject())
        {
            std::set<std::string_view> names;
            for (const auto& member : value.GetObject())
            {
                if (!names.insert(GetText(member.name)).second)
                {
                    return "the name " + std::string(GetText(member.name)) + " stands twice";
                }
                open.push_back(&member.value);
            }
        }
    }
    return std::nullopt;
}

std::string ToText(const rapidjson::Pointer& pointer)
{
    rapidjson::StringBuffer buffer;
    pointer.StringifyUriFragment(buffer);
    return {buffer.GetString(), buffer.GetSize()};
}

std::optional<std::string> FindHeaderFaultOrNull(const rapidjson::Value& message, EVda5050Version version)
{
    const auto time = message.FindMember("timestamp");
    if (time != message.MemberEnd())
    {
        const std::string_view text = GetText(time->value);
        const bool bZone = text.ends_with('Z') || text.find_first_of("+-", text.find('T')) != std::string_view::npos;
        if (!Core::ParseTimestamp(text).has_value() || !bZone)
        {
            return "#/timestamp is no date-time: " + std::string(text);
        }
    }
    const auto said = message.FindMember("version");
    if (said != message.MemberEnd() && GetText(said->value) != VDA5050::GetVersionText(version))
    {
        return "#/version is not " + std::string(VDA5050::GetVersionText(version)) + " but "
            + std::string(GetText(said->value));
    }
    return std::nullopt;
}

} // namespace

bool HasSchemas()
{
    return std::filesystem::is_directory(GetSchemaFolder());
}

std::optional<std::string> FindSchemaFaultOrNull(EVda5050Version version, ETopic topic, std::string_view payload)
{
    static const SchemaShelf SHELF;
    rapidjson::Document message;
    message.Parse<FLAGS>(payload.data(), payload.size());
    if (message.HasParseError())
    {
        return "no JSON at byte " + std::to_string(message.GetErrorOffset()) + ": "
            + rapidjson::GetParseError_En(message.GetParseError());
    }
    rapidjson::SchemaValidator validator(SHELF.GetSchema(version, topic));
    if (!message.Accept(validator))
    {
        return ToText(validator.GetInvalidDocumentPointer()) + " breaks " + validator.GetInvalidSchemaKeyword() + " of "
            + ToText(validator.GetInvalidSchemaPointer());
    }
    std::optional<std::string> fault = FindDoubleNameOrNull(message);
    return fault.has_value() ? fault : FindHeaderFaultOrNull(message, version);
}

void CheckValid(EVda5050Version version, std::string_view topic, std::string_view payload)
{
    if (!HasSchemas())
    {
        static const bool B_WARNED = [] {
            WARN(
                "skipped: ACS_SPEC_DIR does not name a folder with vda5050/schemas, published messages are not checked");
            return true;
        }();
        static_cast<void>(B_WARNED);
        return;
    }
    INFO(topic << " " << payload);
    const Core::Result<VDA5050::ParsedTopic> parsed = VDA5050::ParseTopic(topic);
    CHECK(parsed.has_value());
    if (parsed.has_value())
    {
        CHECK(FindSchemaFaultOrNull(version, parsed->topic, payload).value_or("") == "");
    }
}

void CheckValid(std::string_view topic, std::string_view payload)
{
    rapidjson::Document message;
    message.Parse<FLAGS>(payload.data(), payload.size());
    bool bNewer = false;
    if (message.IsObject())
    {
        const auto version = message.FindMember("version");
        bNewer = version != message.MemberEnd() && version->value == "2.1.0";
    }
    CheckValid(bNewer ? EVda5050Version::Version210 : EVda5050Version::Version200, topic, payload);
}

} // namespace ACS::Testing
