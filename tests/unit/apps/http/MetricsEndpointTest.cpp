#include "common/http/MetricsEndpoint.hpp"

#include "Catch.hpp"

#include <string>

namespace Apps = ACS::Apps;
using Catch::Matchers::Contains;

TEST_CASE("Counters and gauges appear by name and labels")
{
    Apps::MetricsEndpoint metrics;
    metrics.AddCounter("acs_plans_total", "Plans by result");
    metrics.AddGauge("acs_robots_online", "Robots that are online");
    metrics.Increment("acs_plans_total", {{"result", "completed"}});
    metrics.Increment("acs_plans_total", {{"result", "completed"}}, 2.0);
    metrics.Increment("acs_plans_total", {{"result", "the \"no\""}});
    metrics.SetGauge("acs_robots_online", {}, 5.0);
    metrics.SetGauge("acs_robots_online", {}, 4.0);
    const std::string text = metrics.Render();
    REQUIRE_THAT(text, Contains("# HELP acs_plans_total Plans by result\n"));
    REQUIRE_THAT(text, Contains("# TYPE acs_plans_total counter\n"));
    REQUIRE_THAT(text, Contains("acs_plans_total{result=\"completed\"} 3\n"));
    REQUIRE_THAT(text, Contains("acs_plans_total{result=\"the \\\"no\\\"\"} 1\n"));
    REQUIRE_THAT(text, Contains("acs_robots_online 4\n"));
}

TEST_CASE("A counter is raised to a given total and never decreases")
{
    Apps::MetricsEndpoint metrics;
    metrics.AddCounter("acs_messages_total", "Messages");
    metrics.SetTotal("acs_messages_total", {}, 7.0);
    metrics.SetTotal("acs_messages_total", {}, 9.0);
    metrics.SetTotal("acs_messages_total", {}, 3.0);
    REQUIRE_THAT(metrics.Render(), Contains("acs_messages_total 9\n"));
}

TEST_CASE("A histogram counts the values up to each bound and sums all values")
{
    Apps::MetricsEndpoint metrics;
    metrics.AddHistogram("acs_wait_seconds", "A wait", {0.1, 1.0});
    metrics.Observe("acs_wait_seconds", {{"kind", "a"}}, 0.05);
    metrics.Observe("acs_wait_seconds", {{"kind", "a"}}, 0.5);
    metrics.Observe("acs_wait_seconds", {{"kind", "a"}}, 5.0);
    const std::string text = metrics.Render();
    REQUIRE_THAT(text, Contains("# TYPE acs_wait_seconds histogram\n"));
    REQUIRE_THAT(text, Contains("acs_wait_seconds_bucket{kind=\"a\",le=\"0.1\"} 1\n"));
    REQUIRE_THAT(text, Contains("acs_wait_seconds_bucket{kind=\"a\",le=\"1\"} 2\n"));
    REQUIRE_THAT(text, Contains("acs_wait_seconds_bucket{kind=\"a\",le=\"+Inf\"} 3\n"));
    REQUIRE_THAT(text, Contains("acs_wait_seconds_sum{kind=\"a\"} 5.55\n"));
}

TEST_CASE("Replaced series of a gauge disappear, and created series begin with 0")
{
    Apps::MetricsEndpoint metrics;
    metrics.AddGauge("acs_alarms", "Alarms");
    metrics.AddCounter("acs_events_total", "Events");
    metrics.AddHistogram("acs_wait_seconds", "A wait", {1.0});
    metrics.ReplaceGauges("acs_alarms", {{{{"code", "A"}}, 1.0}, {{{"code", "B"}}, 2.0}});
    REQUIRE_THAT(metrics.Render(), Contains("acs_alarms{code=\"A\"} 1\n") && Contains("acs_alarms{code=\"B\"} 2\n"));
    metrics.ReplaceGauges("acs_alarms", {{{{"code", "B"}}, 1.0}, {{{"code", "C"}}, 1.0}});
    REQUIRE_THAT(metrics.Render(), !Contains("code=\"A\"") && Contains("acs_alarms{code=\"B\"} 1\n"));
    metrics.ReplaceGauges("acs_alarms", {});
    REQUIRE_THAT(metrics.Render(), !Contains("acs_alarms{"));

    metrics.CreateCounter("acs_events_total");
    metrics.CreateHistogram("acs_wait_seconds");
    REQUIRE_THAT(metrics.Render(), Contains("acs_events_total 0\n") && Contains("acs_wait_seconds_count 0\n"));
    metrics.Increment("acs_events_total");
    metrics.CreateCounter("acs_events_total");
    REQUIRE_THAT(metrics.Render(), Contains("acs_events_total 1\n"));
}

TEST_CASE("The response to a scrape names its text format")
{
    const Apps::HttpResponse response = Apps::MetricsEndpoint().Respond();
    REQUIRE(response.status == 200);
    REQUIRE_THAT(response.contentType, Contains("version=0.0.4"));
}
