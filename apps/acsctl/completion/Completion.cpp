#include "completion/Completion.hpp"

#include "options/AcsctlParser.hpp"
#include "view/DisplayText.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

/// Signs without a meaning for a shell.
constexpr std::string_view SAFE_SIGNS = "._:@%+/-,=";

struct Choice
{
    std::string_view name; ///< Of an option or a positional argument.
    ECompletionSource source;
    std::vector<std::string> words;
};

const std::vector<Choice>& ListChoices()
{
    static const std::vector<Choice> CHOICES{
        {"--state", ECompletionSource::None, {"active", "waiting", "unfinished", "finished"}},
        {"--types", ECompletionSource::None, {"entry", "changes", "entry,changes"}},
        {"--robot", ECompletionSource::Robots, {}},
        {"--plan", ECompletionSource::Plans, {}},
        {"--context", ECompletionSource::Contexts, {}},
        {"--token-file", ECompletionSource::Files, {}},
        {"--ca", ECompletionSource::Files, {}},
        {"--certificate", ECompletionSource::Files, {}},
        {"--key", ECompletionSource::Files, {}},
        {"--file", ECompletionSource::Files, {}},
        {"PLAN", ECompletionSource::Plans, {}},
        {"ROBOT", ECompletionSource::Robots, {}},
        {"JOB", ECompletionSource::Jobs, {}},
        {"STEP", ECompletionSource::Steps, {}},
        {"CODE", ECompletionSource::Alarms, {}},
        {"TYPE", ECompletionSource::Actions, {}},
        {"NAME", ECompletionSource::Contexts, {}},
        {"FILE", ECompletionSource::Files, {}},
        {"OUTCOME", ECompletionSource::None, {"done", "failed", "again"}},
        {"MODE", ECompletionSource::None, {"on", "off"}},
        {"KIND", ECompletionSource::None, {"node", "edge", "station"}},
        {"SHELL", ECompletionSource::None, {"bash", "zsh"}},
    };
    return CHOICES;
}

CompletionNeed MakeNeed(std::string_view name, std::string subject)
{
    const auto found = std::ranges::find(ListChoices(), name, &Choice::name);
    if (found == ListChoices().end())
    {
        return {};
    }
    return {found->words, found->source, std::move(subject)};
}

/// The command that the words name so far.
struct Place
{
    const CLI::App* app = nullptr;
    const CLI::Option* waitingOrNull = nullptr; ///< An option whose value is the next word.
    std::vector<std::string> positionals;
    bool bOnlyPositionals = false; ///< After "--".
};

/// The option of the command, or of one above it.
const CLI::Option* FindOptionOrNull(const CLI::App* appOrNull, const std::string& name)
{
    for (; appOrNull != nullptr; appOrNull = appOrNull->get_parent())
    {
        if (const CLI::Option* const optionOrNull = appOrNull->get_option_no_throw(name); optionOrNull != nullptr)
        {
            return optionOrNull;
        }
    }
    return nullptr;
}

const CLI::App* FindCommandOrNull(const CLI::App& app, const std::string& name)
{
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    const auto found =
        std::ranges::find_if(commands, [&name](const CLI::App* command) { return command->get_name() == name; });
    return found == commands.end() ? nullptr : *found;
}

void Advance(Place& place, const std::string& word)
{
    if (place.waitingOrNull != nullptr)
    {
        place.waitingOrNull = nullptr;
        return;
    }
    if (word == "--" && place.app->get_name() != "carriers") // of carriers: no carrier
    {
        place.bOnlyPositionals = true;
        return;
    }
    if (word.size() > 1 && word.front() == '-' && !place.bOnlyPositionals)
    {
        const CLI::Option* const optionOrNull = FindOptionOrNull(place.app, word);
        const bool bValue = optionOrNull != nullptr && optionOrNull->get_items_expected_max() > 0;
        place.waitingOrNull = bValue && word != "--watch" ? optionOrNull : nullptr;
        return;
    }
    const CLI::App* const commandOrNull = place.bOnlyPositionals ? nullptr : FindCommandOrNull(*place.app, word);
    if (commandOrNull != nullptr)
    {
        place.app = commandOrNull;
        return;
    }
    place.positionals.push_back(word);
}

std::vector<std::string> ListOptions(const CLI::App* appOrNull)
{
    std::vector<std::string> names;
    for (; appOrNull != nullptr; appOrNull = appOrNull->get_parent())
    {
        for (const CLI::Option* option : appOrNull->get_options())
        {
            for (const std::string& name : option->get_lnames())
            {
                names.push_back("--" + name);
            }
        }
    }
    return names;
}

/// The positional argument that comes next; the last one may be repeated (carriers).
const CLI::Option* FindPositionalOrNull(const Place& place)
{
    std::vector<const CLI::Option*> positionals;
    for (const CLI::Option* option : place.app->get_options())
    {
        if (option->get_positional())
        {
            positionals.push_back(option);
        }
    }
    const std::size_t index = place.positionals.size();
    return index < positionals.size() ? positionals[index] : nullptr;
}

CompletionNeed CompletePositional(const Place& place)
{
    const CLI::Option* const positionalOrNull = FindPositionalOrNull(place);
    if (positionalOrNull == nullptr)
    {
        return {};
    }
    const std::string name = positionalOrNull->get_name(true);
    std::string subject = place.positionals.empty() ? std::string() : place.positionals.front();
    if (name == "ID")
    {
        return {
            {},
            place.app->get_name() == "why" ? ECompletionSource::PlansAndRobots : ECompletionSource::Places,
            std::move(subject)};
    }
    return MakeNeed(name, std::move(subject));
}

} // namespace

CompletionNeed FindCompletion(const std::vector<std::string>& words)
{
    AcsctlOptions unused;
    CLI::App app{DESCRIPTION, std::string(PROGRAM_NAME)};
    BuildCommandLine(app, unused);
    Place place;
    place.app = &app;
    const std::size_t before = words.empty() ? 0 : words.size() - 1;
    for (std::size_t i = 0; i < before; ++i)
    {
        Advance(place, words[i]);
    }
    const std::string last = words.empty() ? std::string() : words.back();
    if (place.waitingOrNull != nullptr)
    {
        return MakeNeed("--" + place.waitingOrNull->get_lnames().front(), {});
    }
    const std::size_t equals = last.find('=');
    if (last.starts_with("--") && equals != std::string::npos && !place.bOnlyPositionals)
    {
        const CLI::Option* const optionOrNull = FindOptionOrNull(place.app, last.substr(0, equals));
        CompletionNeed need =
            optionOrNull == nullptr ? CompletionNeed() : MakeNeed("--" + optionOrNull->get_lnames().front(), {});
        need.prefix = last.substr(0, equals + 1);
        return need;
    }
    CompletionNeed need = CompletePositional(place);
    need.bBeforeDashes = !place.bOnlyPositionals;
    if (last.starts_with('-') && !place.bOnlyPositionals)
    {
        need.words = ListOptions(place.app);
        return need;
    }
    if (place.positionals.empty() && !place.bOnlyPositionals)
    {
        for (const CLI::App* command : std::as_const(*place.app).get_subcommands({}))
        {
            need.words.push_back(command->get_name());
        }
    }
    return need;
}

ConnectionOptions ReadConnectionOptions(const std::vector<std::string>& words)
{
    ConnectionOptions options;
    const std::array<std::pair<std::string_view, std::optional<std::string>*>, 6> targets{{
        {"--context", &options.context},
        {"--url", &options.url},
        {"--token-file", &options.tokenFile},
        {"--ca", &options.ca},
        {"--certificate", &options.certificate},
        {"--key", &options.key},
    }};
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::size_t equals = words[i].find('=');
        const std::string_view name = std::string_view(words[i]).substr(0, equals);
        const auto* const target =
            std::ranges::find_if(targets, [name](const auto& entry) { return entry.first == name; });
        if (target == targets.end())
        {
            continue;
        }
        if (equals != std::string::npos)
        {
            *target->second = words[i].substr(equals + 1);
        }
        else if (i + 2 < words.size()) // the last word is being written
        {
            *target->second = words[i + 1];
        }
    }
    return options;
}

void ReplaceDashedNames(std::vector<std::string>& names)
{
    const auto dashed = std::ranges::count_if(names, [](const std::string& name) { return name.starts_with('-'); });
    std::erase_if(names, [](const std::string& name) { return name.starts_with('-'); });
    if (dashed != 0)
    {
        names.emplace_back("--");
    }
}

std::vector<std::string> SelectCandidates(std::vector<std::string> candidates, std::string_view begin)
{
    std::erase_if(candidates, [begin](const std::string& candidate) {
        const bool bSafe = std::ranges::all_of(candidate, [](char letter) {
            const bool bLetter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
            const bool bWide = static_cast<unsigned char>(letter) >= 0x80U; // of UTF-8
            return bLetter || bWide || (letter >= '0' && letter <= '9')
                || SAFE_SIGNS.find(letter) != std::string_view::npos;
        });
        const bool bShown = MakeDisplayable(candidate) == candidate; // no control characters above ASCII
        return candidate.empty() || !bSafe || !bShown || !candidate.starts_with(begin);
    });
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    return candidates;
}

} // namespace ACS::Acsctl
