// SPDX-License-Identifier: MIT
// The panel's building blocks: a label at the left, a control or a number at the right.
#pragma once

#include <initializer_list>
#include <string>

#include <imgui.h>

#include "app/viewer/layout_report.h"
#include "app/viewer/panels/format.h"
#include "app/viewer/style.h"

namespace app {

/// What every panel draws with.
struct Ui {
  LayoutReport& layout;
  const Fonts& fonts;
  float scale = 1;  // of sizes given in unscaled coordinates
};

/// A heading that folds what follows; true when unfolded.
bool section(const Ui& ui, const char* title);
/// A part of a section that few need, closed until it is clicked; whether it is open.
bool closed_part(const Ui& ui, const char* title);
/// Writes the label and puts the next item into the column of controls.
void control_label(const Ui& ui, const std::string& label);
/// To be called after a control: reports its place as `name`, and says `help` when hovered.
void finish_control(const Ui& ui, const std::string& name, const std::string& help);
/// Buttons side by side, of which one is chosen; returns the index chosen now.
int segmented(const Ui& ui, const std::string& name, std::initializer_list<const char*> labels,
              int chosen);
/// Draws what lies below a slider, filled up to `part`, and makes the slider itself transparent
/// until end_slider(). Its width is the room that is left, less `kept_width`.
void begin_slider(double part, float kept_width);
void end_slider();
/// A number, right-aligned, with its unit.
void number_row(const Ui& ui, const char* label, const Quantity& quantity);
/// The same, which says `help` when hovered.
void number_row(const Ui& ui, const char* label, const Quantity& quantity, const std::string& help);
/// Numbers side by side, each in an equal part of the row.
struct Cell {
  const char* label;
  Quantity quantity;
  std::string help;
};
void cell_row(const Ui& ui, std::initializer_list<Cell> cells);
/// Puts the next item at the left of one of `cell_count` equal parts of the row; returns its width.
float place_cell(const Ui& ui, int cell, int cell_count);
/// A wrapped tooltip for the item before it.
void tooltip(const Ui& ui, const std::string& text);

}  // namespace app
