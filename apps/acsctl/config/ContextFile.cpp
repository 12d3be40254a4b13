#include "config/ContextFile.hpp"

#include "common/config/ConfigReader.hpp"
#include "common/config/ConfigSection.hpp"
#include "config/Connection.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t LONGEST_NAME = 64;

Context ReadContext(const Apps::ConfigSection& section)
{
    Context context;
    context.url = section.GetString("url", "");
    context.token = section.GetString("token", "");
    context.tokenFile = section.GetString("token_file", "");
    context.ca = section.GetString("ca", "");
    context.certificate = section.GetString("certificate", "");
    context.key = section.GetString("key", "");
    if (!context.url.empty())
    {
        if (const auto url = ParseHttpURL(context.url); !url.has_value())
        {
            section.AddError("url", url.error());
        }
    }
    if (!context.token.empty() && !context.tokenFile.empty())
    {
        section.AddError("token", "token and token_file exclude each other");
    }
    return context;
}

void Insert(toml::table& table, std::string_view key, const std::string& value)
{
    if (!value.empty())
    {
        table.insert_or_assign(key, value);
    }
}

} // namespace

tl::expected<Contexts, std::string> ReadContexts(std::string_view text, const std::string& fileName)
{
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadText(text, fileName, {});
    const Apps::ConfigSection root = reader.GetRoot();
    Contexts contexts;
    contexts.current = root.GetString("current", "");
    if (root.HasKey("contexts"))
    {
        const Apps::ConfigSection section = root.GetSection("contexts");
        for (const std::string& name : section.GetNames())
        {
            if (!IsContextName(name))
            {
                section.AddError(name, "the name of a context has 1 to 64 letters, digits and . _ -");
            }
            contexts.entries.emplace(name, ReadContext(section.GetSection(name)));
        }
    }
    if (!contexts.current.empty() && !contexts.entries.contains(contexts.current))
    {
        root.AddError("current", "there is no such context");
    }
    const std::vector<std::string> errors = reader.GetErrors();
    if (!errors.empty())
    {
        return tl::make_unexpected(fmt::format("{}", fmt::join(errors, "\n")));
    }
    return contexts;
}

std::string WriteContexts(const Contexts& contexts)
{
    toml::table entries;
    for (const auto& [name, context] : contexts.entries)
    {
        toml::table entry;
        Insert(entry, "url", context.url);
        Insert(entry, "token", context.token);
        Insert(entry, "token_file", context.tokenFile);
        Insert(entry, "ca", context.ca);
        Insert(entry, "certificate", context.certificate);
        Insert(entry, "key", context.key);
        entries.insert_or_assign(name, std::move(entry));
    }
    toml::table root;
    Insert(root, "current", contexts.current);
    root.insert_or_assign("contexts", std::move(entries));
    std::ostringstream out;
    out << root << '\n';
    return out.str();
}

bool IsContextName(std::string_view name)
{
    return !name.empty() && name.size() <= LONGEST_NAME && std::ranges::all_of(name, [](char letter) {
        const bool bLetter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
        return bLetter || (letter >= '0' && letter <= '9') || letter == '.' || letter == '_' || letter == '-';
    });
}

} // namespace ACS::Acsctl
