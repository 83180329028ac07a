//! Colours, type and spacing. Distances are multiples of 4, so that everything lines up.

use egui::{
    Color32, CornerRadius, FontFamily, FontId, IconData, Margin, Stroke, Style, TextStyle, Theme, Visuals, vec2,
};

/// The grid that every distance is a multiple of.
pub const UNIT: f32 = 4.0;

/// Applies both themes to `ctx`; which one is on show is chosen by [`egui::Context::set_theme`].
pub fn install(ctx: &egui::Context) {
    for theme in [Theme::Dark, Theme::Light] {
        ctx.set_style_of(theme, style(theme));
    }
}

/// Colours with a meaning of their own, for the two themes.
#[derive(Clone, Copy)]
pub struct Palette {
    /// What is chosen, and what to press next.
    pub accent: Color32,
    /// Text on the accent.
    pub on_accent: Color32,
    pub absorbed: Color32,
    pub unshot: Color32,
    pub escaped: Color32,
    pub warning: Color32,
    pub error: Color32,
    /// Background of a message.
    pub notice: Color32,
    /// What holds in a list of checks.
    pub pass: Color32,
    /// Curves of a chart, told apart by their hue and, for those who do not see it, by their lightness.
    pub curves: [Color32; 7],
}

impl Palette {
    pub fn of(visuals: &Visuals) -> Self {
        if visuals.dark_mode { DARK } else { LIGHT }
    }
}

const DARK: Palette = Palette {
    accent: Color32::from_rgb(0xf2, 0xb1, 0x4a),
    on_accent: Color32::from_rgb(0x1e, 0x16, 0x08),
    absorbed: Color32::from_rgb(0x5b, 0x8f, 0xd6),
    unshot: Color32::from_rgb(0xf2, 0xb1, 0x4a),
    escaped: Color32::from_rgb(0x8d, 0x93, 0x9e),
    warning: Color32::from_rgb(0xf2, 0xb1, 0x4a),
    error: Color32::from_rgb(0xff, 0x7a, 0x6b),
    notice: Color32::from_rgb(0x2c, 0x30, 0x38),
    pass: Color32::from_rgb(0x57, 0xc0, 0x7a),
    curves: [
        Color32::from_rgb(0xf2, 0xb1, 0x4a),
        Color32::from_rgb(0x6f, 0xb4, 0xf5),
        Color32::from_rgb(0x57, 0xd0, 0x9a),
        Color32::from_rgb(0xf0, 0x8c, 0xc0),
        Color32::from_rgb(0xf5, 0xe8, 0x6a),
        Color32::from_rgb(0xb1, 0x97, 0xf5),
        Color32::from_rgb(0xff, 0x7a, 0x6b),
    ],
};

const LIGHT: Palette = Palette {
    accent: Color32::from_rgb(0xb2, 0x5f, 0x00),
    on_accent: Color32::from_rgb(0xff, 0xff, 0xff),
    absorbed: Color32::from_rgb(0x2f, 0x66, 0xb8),
    unshot: Color32::from_rgb(0xe0, 0x96, 0x1e),
    escaped: Color32::from_rgb(0x8a, 0x90, 0x9a),
    warning: Color32::from_rgb(0xb2, 0x5f, 0x00),
    error: Color32::from_rgb(0xb3, 0x26, 0x1e),
    notice: Color32::from_rgb(0xff, 0xff, 0xff),
    pass: Color32::from_rgb(0x1e, 0x87, 0x4b),
    curves: [
        Color32::from_rgb(0xb2, 0x5f, 0x00),
        Color32::from_rgb(0x1f, 0x6f, 0xc4),
        Color32::from_rgb(0x12, 0x80, 0x5c),
        Color32::from_rgb(0xb8, 0x2c, 0x7c),
        Color32::from_rgb(0x8a, 0x78, 0x00),
        Color32::from_rgb(0x6a, 0x45, 0xc4),
        Color32::from_rgb(0xc4, 0x30, 0x24),
    ],
};

/// The window's icon: a glow on a dark ground.
pub fn icon() -> IconData {
    const SIDE: u32 = 64;
    let ground = DARK.notice;
    let pixel = |index: u32| {
        let [x, y] = [index % SIDE, index / SIDE].map(|i| (i as f32 + 0.5) / SIDE as f32 - 0.5);
        let distance = x.hypot(y);
        let glow = (1.0 - ((distance - 0.16) / 0.3).clamp(0.0, 1.0)).powi(2);
        let [r, g, b, _] = ground.lerp_to_gamma(DARK.accent, glow).to_array();
        [r, g, b, if distance < 0.5 { 255 } else { 0 }]
    };
    IconData { rgba: (0..SIDE * SIDE).flat_map(pixel).collect(), width: SIDE, height: SIDE }
}

fn style(theme: Theme) -> Style {
    let mut style = Style { visuals: visuals(theme), ..Style::default() };
    let font = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles.insert(TextStyle::Small, font(12.0));
    style.text_styles.insert(TextStyle::Body, font(14.0));
    style.text_styles.insert(TextStyle::Button, font(14.0));
    style.text_styles.insert(TextStyle::Heading, font(15.0));
    style.text_styles.insert(TextStyle::Monospace, FontId::new(13.0, FontFamily::Monospace));
    style.drag_value_text_style = TextStyle::Body;

    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(2.0 * UNIT, 2.0 * UNIT);
    spacing.button_padding = vec2(2.5 * UNIT, UNIT);
    spacing.interact_size = vec2(10.0 * UNIT, 7.0 * UNIT);
    spacing.window_margin = Margin::same(16);
    spacing.menu_margin = Margin::same(8);
    spacing.menu_width = 80.0 * UNIT;
    spacing.slider_rail_height = UNIT;
    spacing.combo_width = 30.0 * UNIT;
    spacing.icon_width = 4.0 * UNIT;
    spacing.icon_spacing = 2.0 * UNIT;
    spacing.tooltip_width = 90.0 * UNIT;
    spacing.scroll.bar_width = 2.0 * UNIT;

    style.interaction.selectable_labels = false;
    style.interaction.tooltip_delay = 0.4;
    style.explanation_tooltips = false;
    style
}

fn visuals(theme: Theme) -> Visuals {
    let mut visuals = match theme {
        Theme::Dark => Visuals::dark(),
        Theme::Light => Visuals::light(),
    };
    let palette = Palette::of(&visuals);
    let gray = Color32::from_gray;
    let (panel, text, strong, weak, line, button) = match theme {
        Theme::Dark => (Color32::from_rgb(0x1d, 0x1f, 0x23), gray(216), gray(250), gray(160), gray(54), gray(52)),
        Theme::Light => (Color32::from_rgb(0xf6, 0xf6, 0xf4), gray(32), gray(0), gray(88), gray(208), gray(226)),
    };
    visuals.panel_fill = panel;
    visuals.window_fill = panel;
    visuals.window_stroke = Stroke::new(1.0, line);
    visuals.weak_text_color = Some(weak);
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.hyperlink_color = palette.accent;
    visuals.selection.bg_fill = palette.accent;
    visuals.selection.stroke = Stroke::new(1.0, palette.on_accent);
    visuals.slider_trailing_fill = true;
    visuals.indent_has_left_vline = false;
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(8);

    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_fill = panel;
    widgets.noninteractive.weak_bg_fill = panel;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, text);
    widgets.inactive.fg_stroke = Stroke::new(1.0, text);
    widgets.inactive.weak_bg_fill = button;
    widgets.inactive.bg_fill = button;
    widgets.active.fg_stroke = Stroke::new(1.0, strong);
    for widget in [&mut widgets.noninteractive, &mut widgets.inactive, &mut widgets.hovered, &mut widgets.active] {
        widget.corner_radius = CornerRadius::same(6);
        widget.expansion = 0.0;
    }
    visuals
}
