#include "completion/Completion.hpp"

#include "Catch.hpp"

#include <algorithm>

namespace Acsctl = ACS::Acsctl;
using Acsctl::ECompletionSource;

namespace
{

using Typed = std::vector<std::string>;

bool HasWord(const Acsctl::CompletionNeed& need, const std::string& word)
{
    return std::ranges::find(need.words, word) != need.words.end();
}

} // namespace

TEST_CASE("Commands and options are completed")
{
    CHECK(HasWord(Acsctl::FindCompletion({""}), "plans"));
    CHECK(HasWord(Acsctl::FindCompletion({}), "why"));
    CHECK(HasWord(Acsctl::FindCompletion({"--json", "pl"}), "plans"));
    CHECK(HasWord(Acsctl::FindCompletion({"tsc", ""}), "resume"));
    CHECK_FALSE(HasWord(Acsctl::FindCompletion({"tsc", ""}), "plans"));
    CHECK(HasWord(Acsctl::FindCompletion({"plans", "--"}), "--state"));
    CHECK(HasWord(Acsctl::FindCompletion({"plans", "--"}), "--json"));
    CHECK_FALSE(HasWord(Acsctl::FindCompletion({"robots", "--"}), "--state"));
    CHECK(HasWord(Acsctl::FindCompletion({"plans", "--state", ""}), "finished"));
}

TEST_CASE("Names are completed from the source of the argument")
{
    using Row = std::pair<Typed, ECompletionSource>;
    const auto [words, source] = GENERATE(
        Row{{"plan", ""}, ECompletionSource::Plans},
        Row{{"plan", "--watch", ""}, ECompletionSource::Plans},
        Row{{"plan", "--url", "http://x", ""}, ECompletionSource::Plans},
        Row{{"plan", "P1", ""}, ECompletionSource::None},
        Row{{"why", "L"}, ECompletionSource::PlansAndRobots},
        Row{{"plans", "--robot", ""}, ECompletionSource::Robots},
        Row{{"resolve", "P1", ""}, ECompletionSource::Jobs},
        Row{{"skip", "P1", ""}, ECompletionSource::Steps},
        Row{{"clear", "LR01", ""}, ECompletionSource::Alarms},
        Row{{"block", "node", ""}, ECompletionSource::Places},
        Row{{"context", "use", ""}, ECompletionSource::Contexts},
        Row{{"bundle", ""}, ECompletionSource::Files},
        Row{{"--token-file", ""}, ECompletionSource::Files},
        Row{{"--url", ""}, ECompletionSource::None});
    CAPTURE(words);
    CHECK(Acsctl::FindCompletion(words).source == source);
    CHECK(HasWord(Acsctl::FindCompletion({"resolve", "P1", "J1", ""}), "again"));
    CHECK(Acsctl::FindCompletion({"block", "node", ""}).subject == "node");
}

TEST_CASE("The value of an option is also completed after =")
{
    const Acsctl::CompletionNeed state = Acsctl::FindCompletion({"plans", "--state=f"});
    CHECK(HasWord(state, "finished"));
    CHECK(state.prefix == "--state=");
    CHECK(Acsctl::FindCompletion({"plans", "--robot="}).source == ECompletionSource::Robots);
    CHECK(Acsctl::FindCompletion({"plans", "--odd=x"}).words.empty());
}

TEST_CASE("Names that begin with - are completed after --")
{
    CHECK(Acsctl::FindCompletion({"plan", "--", "-"}).source == ECompletionSource::Plans);
    CHECK_FALSE(HasWord(Acsctl::FindCompletion({"plan", "--", "-"}), "--json"));
    CHECK(Acsctl::FindCompletion({"resolve", "--", "-P", ""}).subject == "-P");
    CHECK_FALSE(Acsctl::FindCompletion({"plan", "--", "-"}).bBeforeDashes);
    CHECK(Acsctl::FindCompletion({"plan", "-"}).bBeforeDashes);
    CHECK(HasWord(Acsctl::FindCompletion({"plan", "-"}), "--json"));
    CHECK_FALSE(Acsctl::FindCompletion({"plans", "--robot", ""}).bBeforeDashes);
    Typed names{"-P1", "P2", "-P3"};
    Acsctl::ReplaceDashedNames(names);
    CHECK(names == Typed{"P2", "--"});
    names.pop_back();
    Acsctl::ReplaceDashedNames(names);
    CHECK(names == Typed{"P2"});
}

TEST_CASE("A candidate is one harmless word of a shell")
{
    CHECK(
        Acsctl::SelectCandidates({"P2", "P1", "P1", "$(reboot)", "P 3", "P;4", "", "Q1", "P로"}, "P")
        == Typed{"P1", "P2", "P로"});
    // NOLINTNEXTLINE(misc-misleading-bidirectional): what is tested
    CHECK(Acsctl::SelectCandidates({"P\u009b31m", "P\u202e", "P\xff", "P\u0085"}, "P").empty());
}

TEST_CASE("The connection is read from words that are not a complete command")
{
    const auto options = Acsctl::ReadConnectionOptions({"--url", "http://x", "--context=c", "plan", "--ca"});
    CHECK(options.url == "http://x");
    CHECK(options.context == "c");
    CHECK_FALSE(options.ca.has_value());
}
