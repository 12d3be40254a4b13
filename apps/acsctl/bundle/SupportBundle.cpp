#include "bundle/SupportBundle.hpp"

#include "api/ApiCodec.hpp"
#include "bundle/TarArchive.hpp"
#include "commands/Answers.hpp"
#include "common/Version.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr unsigned HTTP_FOUND = 200;

struct Collected
{
    std::string fileName;
    std::string source;
    unsigned status = 0; ///< 0: no answer.
    std::string content;
    std::string fault;
    bool bForeign = false; ///< The answer is not that of the route.
};

bool IsJsonObject(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{' && MakeOneLine(text).has_value();
}

bool HasOnlyJsonLines(std::string_view text)
{
    while (!text.empty())
    {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (end != 0 && !IsJsonObject(text.substr(0, end)))
        {
            return false;
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return true;
}

/// What the answer of a route is instead of its content; empty if it is that.
std::string FindContentFault(EContent content, const ApiAnswer& answer)
{
    const bool bRight = content == EContent::Json ? IsJsonObject(answer.body)
        : content == EContent::Lines              ? HasOnlyJsonLines(answer.body)
                                                  : answer.contentType.starts_with("text/plain");
    const std::string type = answer.contentType.empty() ? "without a type" : answer.contentType;
    return bRight ? std::string() : fmt::format("the answer is not that of acsd: its content is {}", type);
}

Collected Collect(IApi& api, std::string_view listenKey, const BundlePart& part)
{
    Collected collected{part.fileName, part.target, 0, {}, {}};
    ApiRequest request;
    request.target = part.target;
    tl::expected<ApiAnswer, ApiFailure> answer = api.Send(request);
    if (!answer.has_value())
    {
        collected.fault = answer.error().text;
        return collected;
    }
    constexpr unsigned UNAVAILABLE = 503; // the answer of /readyz while acsd is not ready
    collected.status = answer->status;
    if (const Outcome<std::string> body = GetBodyFrom(listenKey, *answer);
        !body.has_value() && !(answer->status == UNAVAILABLE && part.target == "/readyz"))
    {
        collected.fault = body.error().text;
        collected.bForeign = body.error().exitCode == EXIT_BAD_ANSWER;
        return collected;
    }
    if (collected.fault = FindContentFault(part.content, *answer); !collected.fault.empty())
    {
        collected.bForeign = true;
        return collected;
    }
    collected.content = std::move(answer->body);
    return collected;
}

std::string MakeManifest(const std::vector<Collected>& parts, const std::string& url, Core::WallTime now)
{
    std::string out;
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key("acsctl");
    writer.WriteString(Apps::VERSION);
    writer.Key("url");
    writer.WriteString(url);
    writer.Key("time");
    writer.WriteString(Core::FormatUTC(now));
    writer.Key("files");
    writer.BeginArray();
    for (const Collected& part : parts)
    {
        writer.BeginObject();
        writer.Key("name");
        writer.WriteString(part.fileName);
        writer.Key("source");
        writer.WriteString(part.source);
        writer.Key("status");
        writer.WriteUnsigned(part.status);
        writer.Key("bytes");
        writer.WriteUnsigned(part.content.size());
        writer.Key("error");
        if (part.fault.empty())
        {
            writer.WriteNull();
        }
        else
        {
            writer.WriteString(part.fault);
        }
        writer.EndObject();
    }
    writer.EndArray();
    writer.EndObject();
    return MakeDisplayableJSON(out) + "\n";
}

/// "acsctl-20261127T231000Z/"
std::string MakeFolder(Core::WallTime now)
{
    std::string time = Core::FormatUTC(now);
    time.erase(std::min(time.find('.'), time.size()));
    std::erase_if(time, [](char letter) { return letter == '-' || letter == ':'; });
    return fmt::format("acsctl-{}Z/", time);
}

} // namespace

std::vector<BundlePart> ListBundleParts()
{
    return {
        {"status.json", "/v1/status"},
        {"snapshot.json", "/v1/snapshot"},
        {"plans.json", "/v1/plans?state=unfinished&limit=1000"},
        {"plans-finished.json", "/v1/plans?state=finished&limit=1000"},
        {"robots.json", "/v1/robots"},
        {"alarms.json", "/v1/alarms"},
        {"links.json", "/v1/links"},
        {"queue.json", "/v1/queue"},
        {"site.json", "/v1/site"},
        {"audit.ndjson", "/v1/audit?limit=1000", EContent::Lines},
        {"trace.ndjson", "/v1/trace?limit=1000", EContent::Lines},
        {"openapi.json", "/v1/openapi.json"}};
}

std::vector<BundlePart> ListHttpParts()
{
    return {{"metrics.txt", "/metrics", EContent::Text}, {"readyz.txt", "/readyz", EContent::Text}};
}

Outcome<SupportBundle> CollectBundle(IApi& api, IApi* httpOrNull, const std::string& url, Core::WallTime now)
{
    std::vector<BundlePart> wanted = ListBundleParts();
    // Without the first part the others are not there either.
    Outcome<std::string> first = Get(api, wanted.front().target);
    if (!first.has_value())
    {
        return tl::make_unexpected(first.error());
    }
    if (const Core::Result<StatusInfo> status = DecodeAnswer<StatusInfo>(*first); !status.has_value())
    {
        return MakeBadAnswer(status.error());
    }
    std::vector<Collected> parts{{wanted.front().fileName, wanted.front().target, HTTP_FOUND, std::move(*first), {}}};
    wanted.erase(wanted.begin());
    for (const BundlePart& part : wanted)
    {
        parts.push_back(Collect(api, "operator.listen", part));
    }
    if (httpOrNull != nullptr)
    {
        for (const BundlePart& part : ListHttpParts())
        {
            parts.push_back(Collect(*httpOrNull, "http.listen", part));
        }
    }
    SupportBundle bundle;
    bundle.manifest = MakeManifest(parts, url, now);
    TarArchive archive;
    const std::string folder = MakeFolder(now);
    const std::int64_t seconds = std::chrono::duration_cast<std::chrono::seconds>(now.time_since_epoch()).count();
    archive.Add(folder + "manifest.json", bundle.manifest, seconds);
    for (const Collected& part : parts)
    {
        if (part.fault.empty())
        {
            archive.Add(folder + part.fileName, part.content, seconds);
        }
        else
        {
            bundle.missing.push_back(fmt::format("{}: {}", part.fileName, part.fault));
            bundle.bForeign = bundle.bForeign || part.bForeign;
        }
    }
    bundle.archive = CompressGzip(archive.Finish());
    return bundle;
}

} // namespace ACS::Acsctl
