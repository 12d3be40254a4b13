#include "MessageSample.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// The JSON blocks of the project's own summary of the protocol, in their order.
std::vector<std::string> ListExamples(const std::filesystem::path& path)
{
    const std::string begin = "```json\n";
    const std::string end = "```";
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::string> examples;
    for (std::size_t from = text.find(begin); from != std::string::npos; from = text.find(begin, from))
    {
        from += begin.size();
        const std::size_t to = text.find(end, from);
        examples.push_back(text.substr(from, to - from));
    }
    return examples;
}

std::string WriteJSON(const rapidjson::Value& value)
{
    rapidjson::StringBuffer buffer;
    rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
    value.Accept(writer);
    return {buffer.GetString(), buffer.GetSize()};
}

bool HasMember(const std::string& example, const char* name)
{
    rapidjson::Document document;
    document.Parse(example.c_str());
    return document.IsObject() && document.HasMember(name);
}

/// The first example with this member.
std::string Find(const std::vector<std::string>& examples, const char* name)
{
    const auto found =
        std::ranges::find_if(examples, [name](const std::string& example) { return HasMember(example, name); });
    REQUIRE(found != examples.end());
    return *found;
}

template <typename TMessage>
TMessage Read(const std::string& text, const DecodeTolerance& tolerance = {})
{
    Vda5050Codec codec;
    Core::Result<TMessage> message = codec.Decode<TMessage>(text);
    if (!message)
    {
        FAIL(Core::Describe(message.error()) << " in " << text);
    }
    CHECK(codec.GetTolerance() == tolerance);
    return std::move(*message);
}

} // namespace

TEST_CASE("11 The examples of the project's own summary are decoded unchanged")
{
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no test changes its environment
    const char* folder = std::getenv("ACS_SPEC_DIR");
    const std::filesystem::path path =
        std::filesystem::path(folder == nullptr ? "" : folder) / "sources/vda5050-protocol-definition.ko.md";
    if (!std::filesystem::exists(path))
    {
        WARN("skipped: ACS_SPEC_DIR does not name a folder with the summary of VDA5050");
        return;
    }
    const std::vector<std::string> examples = ListExamples(path);
    CHECK(Read<ConnectionMessage>(Find(examples, "connectionState")).connectionState == EConnectionState::Online);

    // The summary shows single nodes and edges: here they are completed to an order.
    std::string order = Find(examples, "nodes");
    const std::string node = Find(examples, "nodePosition");
    order = Replace(order, R"("nodes": [])", R"("nodes":[)" + node + "," + node + "]");
    order = Replace(order, R"("edges": [])", R"("edges":[)" + Find(examples, "startNodeId") + "]");
    const auto read = Read<OrderMessage>(order, DecodeTolerance{0, 1, 0}); // "trajectory": null
    CHECK(read.nodes.at(1).nodePosition->allowedDeviationXY == 0.5);
    CHECK(read.edges.at(0).corridor->corridorReferencePoint == ECorridorReferencePoint::KinematicCenter);
    CHECK_FALSE(read.edges.at(0).trajectory.has_value());

    for (const std::string& example : examples)
    {
        if (HasMember(example, "headerId") && HasMember(example, "actions"))
        {
            CHECK(Read<InstantActionsMessage>(example).actions.at(0).actionType == "startPause");
        }
        if (HasMember(example, "actionType"))
        {
            const auto instant = Read<InstantActionsMessage>(
                R"({"headerId":1,"timestamp":"2024-01-15T10:30:00.000Z","version":"2.0.0","manufacturer":"m",)"
                R"("serialNumber":"s","actions":[)"
                + example + "]}");
            CHECK_FALSE(instant.actions.at(0).actionType.empty());
        }
    }

    // The state, with each separately shown part of a state inserted.
    const std::string state = Find(examples, "lastNodeId");
    CHECK(Read<StateMessage>(state).batteryState.reach == 5000.0);
    std::size_t parts = 0;
    for (const std::string& example : examples)
    {
        rapidjson::Document part;
        part.Parse(example.c_str());
        REQUIRE_FALSE(part.HasParseError());
        rapidjson::Document whole;
        whole.Parse(state.c_str());
        const bool bPart = std::ranges::any_of(
            std::array{"nodeStates", "actionStates", "loads", "errors", "safetyState", "maps"},
            [&part](const char* name) { return part.HasMember(name) && !part.HasMember("headerId"); });
        if (bPart)
        {
            ++parts;
            for (const auto& member : std::as_const(part).GetObject())
            {
                whole[member.name].CopyFrom(member.value, whole.GetAllocator());
            }
            static_cast<void>(Read<StateMessage>(WriteJSON(whole)));
        }
    }
    CHECK(parts == 6);
}

} // namespace ACS::VDA5050::Test
