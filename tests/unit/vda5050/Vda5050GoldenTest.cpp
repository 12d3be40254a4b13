#include "Catch.hpp"
#include "MessageSample.hpp"
#include "SchemaCheck.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

struct Rewritten
{
    std::string text;
    DecodeTolerance tolerance;
};

/// Decodes, encodes in the version, and checks that decoding that gives an equal message.
template <typename TMessage>
Rewritten Rewrite(const std::string& text, EVda5050Version version)
{
    Vda5050Codec codec;
    Core::Result<TMessage> message = codec.Decode<TMessage>(text);
    if (!message)
    {
        FAIL(Core::Describe(message.error()) << " in " << text);
    }
    const DecodeTolerance tolerance = codec.GetTolerance();
    const bool bSameVersion = message->header.version == GetVersionText(version);
    message->header.version = GetVersionText(version);
    Rewritten rewritten{codec.Encode(*message, version), tolerance};
    const Core::Result<TMessage> again = codec.Decode<TMessage>(rewritten.text);
    REQUIRE(again.has_value());
    CHECK(codec.GetTolerance() == DecodeTolerance{});
    CHECK((!bSameVersion || *again == *message));
    CHECK(codec.Encode(*again, version) == rewritten.text);
    return rewritten;
}

/// Null where the text is another message.
template <typename TMessage>
std::optional<std::string> RewriteOrNull(const std::string& text, EVda5050Version version)
{
    Vda5050Codec codec;
    Core::Result<TMessage> message = codec.Decode<TMessage>(text);
    if (!message)
    {
        return std::nullopt;
    }
    message->header.version = GetVersionText(version);
    return codec.Encode(*message, version);
}

struct GoldenKind
{
    ETopic topic;
    Rewritten (*rewrite)(const std::string& text, EVda5050Version version);
    std::optional<std::string> (*rewriteOrNull)(const std::string& text, EVda5050Version version);
    bool bOptionals; ///< Whether anything may be missing.
};

constexpr std::array<GoldenKind, TOPIC_COUNT> GOLDEN_KINDS{
    GoldenKind{ETopic::Order, &Rewrite<OrderMessage>, &RewriteOrNull<OrderMessage>, true},
    GoldenKind{ETopic::InstantActions, &Rewrite<InstantActionsMessage>, &RewriteOrNull<InstantActionsMessage>, true},
    GoldenKind{ETopic::State, &Rewrite<StateMessage>, &RewriteOrNull<StateMessage>, true},
    GoldenKind{ETopic::Visualization, &Rewrite<VisualizationMessage>, &RewriteOrNull<VisualizationMessage>, true},
    GoldenKind{ETopic::Connection, &Rewrite<ConnectionMessage>, &RewriteOrNull<ConnectionMessage>, false},
    GoldenKind{ETopic::Factsheet, &Rewrite<FactsheetMessage>, &RewriteOrNull<FactsheetMessage>, true}};

void CheckSchema(EVda5050Version version, ETopic topic, const std::string& text)
{
    Testing::CheckValid(version, BuildTopic(VehicleAddress{"uagv", "KIT", "1"}, topic), text);
}

} // namespace

TEST_CASE(
    "3 Every message of every version, full and minimal, decodes and encodes to the same bytes, as its schema asks")
{
    for (const EVda5050Version version : VERSIONS)
    {
        for (const GoldenKind& kind : GOLDEN_KINDS)
        {
            for (const std::string variant : {"full", "minimal"})
            {
                INFO(MakeGoldenName(kind.topic, version, variant));
                const std::string text = ReadGolden(kind.topic, version, variant);
                const Rewritten rewritten = kind.rewrite(text, version);
                CHECK(rewritten.text == text);
                CHECK(rewritten.tolerance == DecodeTolerance{});
                CheckSchema(version, kind.topic, rewritten.text);
            }
        }
    }
}

TEST_CASE("12 (13) With null or nothing in every optional member a message is the minimal one; null is counted")
{
    for (const EVda5050Version version : VERSIONS)
    {
        for (const GoldenKind& kind : GOLDEN_KINDS)
        {
            if (!kind.bOptionals)
            {
                continue;
            }
            INFO(MakeGoldenName(kind.topic, version, "null"));
            const std::string text = ReadGolden(kind.topic, version, "null");
            const std::string minimal = ReadGolden(kind.topic, version, "minimal");
            const Rewritten rewritten = kind.rewrite(text, version);
            CHECK(rewritten.text == minimal);
            CHECK(rewritten.tolerance.nullOptionals > 0);
            CHECK(rewritten.tolerance.unknownMembers == 0);
            const std::string bare = Testing::DropNullMembers(text);
            CHECK(bare.find("null") == std::string::npos);
            CHECK(kind.rewrite(bare, version).text == minimal);
        }
    }
}

TEST_CASE("3 Members that only one version defines are left out in the other")
{
    for (const GoldenKind& kind : GOLDEN_KINDS)
    {
        for (const std::string variant : {"full", "minimal"})
        {
            INFO(MakeGoldenName(kind.topic, EVda5050Version::Version210, variant));
            const std::string newer = ReadGolden(kind.topic, EVda5050Version::Version210, variant);
            CheckSchema(EVda5050Version::Version200, kind.topic, kind.rewrite(newer, EVda5050Version::Version200).text);
            const std::string older = ReadGolden(kind.topic, EVda5050Version::Version200, variant);
            CheckSchema(EVda5050Version::Version210, kind.topic, kind.rewrite(older, EVda5050Version::Version210).text);
        }
    }
}

TEST_CASE("3 The full messages have every member that their schemas name")
{
    if (!Testing::HasSchemas())
    {
        WARN("skipped: ACS_SPEC_DIR does not name a folder with vda5050/schemas");
        return;
    }
    for (const EVda5050Version version : VERSIONS)
    {
        for (const GoldenKind& kind : GOLDEN_KINDS)
        {
            INFO(MakeGoldenName(kind.topic, version, "full"));
            std::vector<std::string> expected;
            if (kind.topic == ETopic::Factsheet)
            {
                // No message, or no useful one, satisfies the schemas of both (section 1).
                expected.emplace_back(
                    version == EVda5050Version::Version200 ? "protocolFeatures.agvActions[].blockingTypes"
                                                           : "agvGeometry.envelopes3d[].description");
            }
            CHECK(Testing::ListAbsentMembers(version, kind.topic, ReadGolden(kind.topic, version, "full")) == expected);
        }
    }
}

TEST_CASE("1, 3 What was read leniently is written as the schema requires, in either version")
{
    std::size_t readable = 0;
    for (const auto& entry : std::filesystem::directory_iterator(ACS_CORPUS))
    {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (const GoldenKind& kind : GOLDEN_KINDS)
        {
            for (const EVda5050Version version : VERSIONS)
            {
                INFO(entry.path());
                const std::optional<std::string> written = kind.rewriteOrNull(text, version);
                if (written.has_value())
                {
                    ++readable;
                    CheckSchema(version, kind.topic, *written);
                }
            }
        }
    }
    CHECK(readable >= 20);
}

TEST_CASE("3.5 The position in visualization has fewer members than in state")
{
    VisualizationMessage message;
    message.agvPosition.emplace().mapDescription = "the floor";
    for (const EVda5050Version version : VERSIONS)
    {
        message.header.version = GetVersionText(version);
        const std::string text = Vda5050Codec().Encode(message, version);
        CHECK(text.find("mapDescription") == std::string::npos);
        CheckSchema(version, ETopic::Visualization, text);
    }
}

TEST_CASE("3 There is a golden file of each kind for every message, and no other")
{
    std::set<std::string> expected;
    for (const EVda5050Version version : VERSIONS)
    {
        for (const GoldenKind& kind : GOLDEN_KINDS)
        {
            expected.insert(MakeGoldenName(kind.topic, version, "full"));
            expected.insert(MakeGoldenName(kind.topic, version, "minimal"));
            if (kind.bOptionals)
            {
                expected.insert(MakeGoldenName(kind.topic, version, "null"));
            }
        }
    }
    CHECK(Testing::ListGolden(ACS_FIXTURES "/golden") == expected);
}

} // namespace ACS::VDA5050::Test
