#pragma once
// What pages hold for their scripts, as JSON text. Text may hold anything.

#include <string>
#include <utility>
#include <vector>

namespace bounce {

std::string data_text(const std::string& text);
/// null where it is not finite.
std::string data_number(double value);
/// Of values that are JSON already.
std::string data_list(const std::vector<std::string>& values);
std::string data_object(const std::vector<std::pair<std::string, std::string>>& members);

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// A measured point as assets/pages/chart.js shows it. Where the page has a table, pictures and command are in its row.
struct PagePoint {
    std::string scene, group, line, label;  ///< chosen from; its colour; whose front it can be on; what names it
    std::string light, kind, command, mark; ///< "": none
    NamedTexts settings, figures, passes;
    std::vector<std::pair<std::string, double>> numbers;  ///< by the keys of costs and errors
    std::vector<std::pair<size_t, std::string>> pictures; ///< of PageChart::pictures, and what each is
};

struct PageCost {
    std::string key, title;
};

struct PageError {
    std::string key, title;
    bool share = false;
    std::string joint_key, joint_title; ///< instead, where points of every light are held to all light
};

struct PageChart {
    std::string scene_title, unset;      ///< what `scene` is; what stands for a setting that a point does not have
    std::string error;                   ///< the key of the one that is drawn first
    std::vector<PageCost> costs, lights; ///< lights: by PagePoint::light
    std::vector<PageError> errors;
    std::vector<std::string> kinds;
    std::vector<std::string> pictures; ///< PNG in base64
    std::vector<PagePoint> points;
};

std::string page_chart_data(const PageChart& chart);

} // namespace bounce
