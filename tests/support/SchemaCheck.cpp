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
#include <map>
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

constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;

/// Keywords that the validator supports, that are checked here ("format"), or that do not restrict a payload.
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

/// Closes every object that names its members; one without names ("data", "localizationParameters") is free
/// intentionally. The only format that is checked is the timestamp of the header, in CheckHeader.
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
            throw std::runtime_error("a schema that is not an object: " + std::string(place.name));
        }
        if (node.HasMember("properties") && !node.HasMember("additionalProperties"))
        {
            node.AddMember("additionalProperties", false, schema.GetAllocator());
        }
        for (const auto& member : std::as_const(node).GetObject())
        {
            const std::string_view keyword = GetText(member.name);
            if (std::ranges::find(KNOWN_KEYWORDS, keyword) == KNOWN_KEYWORDS.end()
                || (keyword == "format" && (place.name != "timestamp" || GetText(member.value) != "date-time")))
            {
                throw std::runtime_error("a schema has a keyword that is not checked: " + std::string(keyword));
            }
            rapidjson::Value& inner = node[member.name];
            if (keyword == "items")
            {
                open.push_back({&inner, keyword});
            }
            if (keyword == "properties" || keyword == "definitions")
            {
                for (const auto& named : std::as_const(inner).GetObject())
                {
                    open.push_back({&inner[named.name], GetText(named.name)});
                }
            }
        }
    }
}

/// A schema as it was read, and the schema for the validator.
struct Schema
{
    rapidjson::Document text;
    std::unique_ptr<rapidjson::SchemaDocument> compiled;

    explicit Schema(const std::filesystem::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        text.Parse<FLAGS>(bytes.data(), bytes.size());
        if (text.HasParseError())
        {
            throw std::runtime_error("no schema in " + path.string());
        }
        CloseObjects(text);
        compiled = std::make_unique<rapidjson::SchemaDocument>(text);
    }
};

using Shelf = std::map<std::pair<EVda5050Version, ETopic>, Schema>;

Shelf LoadSchemas()
{
    Shelf shelf;
    for (const EVda5050Version version : {EVda5050Version::Version200, EVda5050Version::Version210})
    {
        const std::string folder = std::string(VDA5050::GetVersionText(version)) + "-repaired";
        for (std::size_t index = 0; index < VDA5050::TOPIC_COUNT; ++index)
        {
            const auto topic = static_cast<ETopic>(index);
            const std::string name = std::string(VDA5050::GetTopicName(topic)) + ".schema";
            shelf.try_emplace({version, topic}, GetSchemaFolder() / folder / name);
        }
    }
    return shelf;
}

const Schema& GetSchema(EVda5050Version version, ETopic topic)
{
    static const Shelf SHELF = LoadSchemas();
    return SHELF.at({version, topic});
}

/// A place of a schema with all the values that a payload has there.
struct Place
{
    const rapidjson::Value* schema = nullptr;
    std::vector<const rapidjson::Value*> values;
    std::string path;
};

Place EnterItems(const Place& place, const rapidjson::Value& items)
{
    Place inner{&items, {}, place.path + "[]"};
    for (const rapidjson::Value* value : place.values)
    {
        for (const auto& item : value->GetArray())
        {
            inner.values.push_back(&item);
        }
    }
    return inner;
}

Place EnterProperty(const Place& place, const rapidjson::Value& name, const rapidjson::Value& property)
{
    const std::string text(GetText(name));
    Place inner{&property, {}, place.path.empty() ? text : place.path + "." + text};
    for (const rapidjson::Value* value : place.values)
    {
        if (value->HasMember(name))
        {
            inner.values.push_back(&(*value)[name]);
        }
    }
    return inner;
}

/// A name that an object has twice: JSON parsers differ in which of the two they use.
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
                    return "the name " + std::string(GetText(member.name)) + " is repeated";
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
            return "#/timestamp is not a date-time: " + std::string(text);
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
    rapidjson::Document message;
    message.Parse<FLAGS>(payload.data(), payload.size());
    if (message.HasParseError())
    {
        return "invalid JSON at byte " + std::to_string(message.GetErrorOffset()) + ": "
            + rapidjson::GetParseError_En(message.GetParseError());
    }
    rapidjson::SchemaValidator validator(*GetSchema(version, topic).compiled);
    if (!message.Accept(validator))
    {
        return ToText(validator.GetInvalidDocumentPointer()) + " breaks " + validator.GetInvalidSchemaKeyword() + " of "
            + ToText(validator.GetInvalidSchemaPointer());
    }
    std::optional<std::string> fault = FindDoubleNameOrNull(message);
    return fault.has_value() ? fault : FindHeaderFaultOrNull(message, version);
}

std::vector<std::string> ListAbsentMembers(EVda5050Version version, ETopic topic, std::string_view payload)
{
    const rapidjson::Document& schema = GetSchema(version, topic).text;
    rapidjson::Document message;
    message.Parse<FLAGS>(payload.data(), payload.size());
    std::vector<std::string> absent;
    std::vector<Place> open{{&schema, {&message}, ""}};
    while (!open.empty())
    {
        const Place place = std::move(open.back());
        open.pop_back();
        if (place.values.empty())
        {
            absent.push_back(place.path);
            continue;
        }
        const rapidjson::Value& node = *place.schema;
        if (node.HasMember("$ref"))
        {
            open.push_back({rapidjson::Pointer(node["$ref"].GetString()).Get(schema), place.values, place.path});
        }
        if (node.HasMember("items"))
        {
            open.push_back(EnterItems(place, node["items"]));
        }
        if (node.HasMember("properties"))
        {
            for (const auto& property : node["properties"].GetObject())
            {
                open.push_back(EnterProperty(place, property.name, property.value));
            }
        }
    }
    return absent;
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
    const bool bNewer = message.IsObject() && message.HasMember("version") && message["version"] == "2.1.0";
    CheckValid(bNewer ? EVda5050Version::Version210 : EVda5050Version::Version200, topic, payload);
}

} // namespace ACS::Testing
